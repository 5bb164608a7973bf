#include "kestrel/lab/lab_plan.hpp"
