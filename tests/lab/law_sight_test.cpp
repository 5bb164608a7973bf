#include "kestrel/lab/law_sight.hpp"

#include <gtest/gtest.h>
