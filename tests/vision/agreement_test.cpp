#include "kestrel/vision/agreement.hpp"
