#include "scenarios/kinds/needle/needle_task.h"

#include <gtest/gtest.h>
