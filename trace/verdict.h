// SPDX-License-Identifier: MIT
// The answer of an operator, which users see.
#pragma once

#include <tetmend/verdict.h>
