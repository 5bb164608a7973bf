#include "kestrel/vision/target_search.hpp"
