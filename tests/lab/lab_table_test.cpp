#include "kestrel/lab/lab_table.hpp"
