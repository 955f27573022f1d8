// SPDX-License-Identifier: MIT
#pragma once

#include "tbb/stand_in.h"
