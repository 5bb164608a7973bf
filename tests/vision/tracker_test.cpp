#include "kestrel/vision/tracker.hpp"
