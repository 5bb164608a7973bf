#include "kestrel/vision/align.hpp"
