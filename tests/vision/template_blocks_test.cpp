#include "kestrel/vision/template_blocks.hpp"
