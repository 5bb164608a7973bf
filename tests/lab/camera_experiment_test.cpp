#include "kestrel/lab/camera_experiment.hpp"

#include <gtest/gtest.h>
