#include "kestrel/vision/feature_match.hpp"
