#include "kestrel/lab/camera_trace.hpp"

#include <gtest/gtest.h>
