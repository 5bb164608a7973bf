#include "kestrel/lab/planned_runs.hpp"
