// SPDX-License-Identifier: MIT
// The exceptions of tetmend, which users see.
#pragma once

#include <tetmend/error.h>
