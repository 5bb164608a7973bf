#include "kestrel/vision/learned_features.hpp"
