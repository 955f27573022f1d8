/* SPDX-License-Identifier: MIT */
/* The mark of what a program or a plugin sees of the library. All else is hidden when it is built.
 * Also for C, so without comments of C++. */
#pragma once

/* Stands at classes and functions that other programs call. It also makes the type of an exception
 * one and the same on both sides where a program hides its own symbols. */
#if defined(__GNUC__)
#define TETMEND_API __attribute__((visibility("default")))
#else
#define TETMEND_API
#endif
