#include "kestrel/vision/image_pyramid.hpp"
