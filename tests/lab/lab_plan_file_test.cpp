#include "kestrel/lab/lab_plan_file.hpp"
