#include "kestrel/vision/track.hpp"
