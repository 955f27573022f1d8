// SPDX-License-Identifier: MIT
// What is behind a handle of <tetmend/tetmend.h>, and how exceptions become status values.
#pragma once

#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <tetmend/improve.h>
#include <tetmend/mesh.h>
#include <tetmend/option_text.h>
#include <tetmend/tetmend.h>

struct tetmend_mesh {
  tetmend::Mesh mesh;         // unless there is a draft
  tetmend::MeshArrays draft;  // a mesh that is being made of arrays
  bool is_draft = false;
  bool is_from_file = false;
  std::int32_t first_number = 0;
  tetmend::Options options;
  std::string label_array;
  std::string variant;
  tetmend_progress_function progress = nullptr;
  void* user = nullptr;
  std::optional<tetmend::Result> result;
  std::vector<std::string> notes;
  std::vector<std::string> worse;  // than before the last run
  std::string message;
  const char* last_error = "";  // a literal where there is no memory for the message
};

namespace tetmend::c {

/// The caller breaks what the header asks of him.
class WrongCall : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline tetmend_status fail(tetmend_mesh& handle, tetmend_status status, const char* what) noexcept {
  try {
    handle.message = what;
    handle.last_error = handle.message.c_str();
  } catch (...) {
    handle.last_error = "out of memory";
  }
  return status;
}

/// While it lives, this thread computes as the library expects: to the nearest, denormal numbers as
/// they are, without traps. A program in Fortran may have set all of that otherwise. Flags and
/// settings are the caller's again afterwards.
class PlainArithmetic {
 public:
  PlainArithmetic() {
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~PlainArithmetic() { std::fesetenv(&callers_); }
  PlainArithmetic(const PlainArithmetic&) = delete;
  PlainArithmetic& operator=(const PlainArithmetic&) = delete;

 private:
  std::fenv_t callers_{};
};

/// Runs `call` with the handle; nothing that it throws gets out.
template <class Call>
tetmend_status guarded(tetmend_mesh* handle, const Call& call) noexcept {
  if (handle == nullptr) return TETMEND_WRONG_CALL;
  const PlainArithmetic arithmetic;
  try {
    call(*handle);
    handle->last_error = "";
    return TETMEND_OK;
  } catch (const OptionError& error) {
    try {
      return fail(*handle, TETMEND_WRONG_OPTION, message_of(error).c_str());
    } catch (...) {
      return fail(*handle, TETMEND_WRONG_OPTION, error.what());
    }
  } catch (const Error& error) {
    return fail(*handle, TETMEND_WRONG_INPUT, error.what());
  } catch (const WrongCall& error) {
    return fail(*handle, TETMEND_WRONG_CALL, error.what());
  } catch (const std::bad_alloc&) {
    handle->last_error = "out of memory";
    return TETMEND_NO_MEMORY;
  } catch (const std::length_error&) {
    handle->last_error = "out of memory";
    return TETMEND_NO_MEMORY;
  } catch (const std::exception& error) {
    return fail(*handle, TETMEND_FAILED, error.what());
  } catch (...) {
    return fail(*handle, TETMEND_FAILED, "unexpected failure");
  }
}

/// @throws WrongCall when `pointer` is null and something is to be there
inline void need(const void* pointer, const char* name, bool is_needed = true) {
  if (is_needed && pointer == nullptr) throw WrongCall(std::string(name) + " is null");
}

/// @throws WrongCall unless there is room for `count`
inline void need_room(std::size_t room, std::size_t count) {
  if (room < count) {
    throw WrongCall("room for " + std::to_string(room) + ", but there " +
                    (count == 1 ? "is " : "are ") + std::to_string(count));
  }
  if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw WrongCall("there are more than 2^31 - 1");
  }
}

/// The mesh of the handle; arrays that came in become one.
inline Mesh& settle(tetmend_mesh& handle) {
  if (handle.is_draft) {
    handle.is_draft = false;
    MeshArrays arrays = std::move(handle.draft);
    handle.draft = {};
    handle.mesh = Mesh(std::move(arrays));
  }
  return handle.mesh;
}

}  // namespace tetmend::c
