// SPDX-License-Identifier: MIT
// A short list that is a value: what walks return.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

namespace tetmend {

/// Up to N values lie in the object itself, more on the heap. So a walk returns what it found without
/// asking for memory, as a rule, and nothing that a later walk could overwrite.
template <class T, std::size_t N>
class Few {
 public:
  using value_type = T;
  using const_iterator = const T*;

  Few() = default;
  Few(std::initializer_list<T> values) {
    for (const T& value : values) push_back(value);
  }

  void push_back(const T& value) {
    if (size_ < N) {
      here_[size_] = value;
    } else {
      if (size_ == N) more_.assign(here_.begin(), here_.end());
      more_.push_back(value);
    }
    ++size_;
  }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* data() const { return size_ <= N ? here_.data() : more_.data(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  const T& front() const { return data()[0]; }
  const T& back() const { return data()[size_ - 1]; }
  bool contains(const T& value) const { return std::find(begin(), end(), value) != end(); }
  friend bool operator==(const Few& a, const Few& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::size_t size_ = 0;
  std::array<T, N> here_;
  std::vector<T> more_;  // all of them, once there are more than N
};

}  // namespace tetmend
