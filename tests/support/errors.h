// SPDX-License-Identifier: MIT
// Errors as text.
#pragma once

#include <string>

#include <tetmend/error.h>

namespace tetmend::test {

/// The message of the Error that the call throws; empty when it throws none.
template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace tetmend::test
