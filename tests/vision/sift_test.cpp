#include "kestrel/vision/sift.hpp"
