#include "kestrel/lab/run_metrics.hpp"

#include <gtest/gtest.h>
