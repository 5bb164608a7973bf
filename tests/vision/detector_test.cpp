#include "kestrel/vision/detector.hpp"
