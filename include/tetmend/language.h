// SPDX-License-Identifier: MIT
// Says what is missing, in place of pages of messages, where the headers for C++ are compiled for an
// older standard. The header for C, <tetmend/tetmend.h>, needs none.
#pragma once

#if defined(_MSVC_LANG)
#define TETMEND_CXX _MSVC_LANG
#elif defined(__cplusplus)
#define TETMEND_CXX __cplusplus
#else
#define TETMEND_CXX 0
#endif
#if TETMEND_CXX < 202002L && !(defined(__GNUC__) && TETMEND_CXX > 201703L)
#error "The C++ headers of tetmend need C++20; C++17 has <tetmend/tetmend.hpp>, C tetmend.h."
#endif
#undef TETMEND_CXX
