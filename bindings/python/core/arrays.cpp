// SPDX-License-Identifier: MIT
#include "bindings/python/core/arrays.h"

#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <tetmend/error.h>
#include <tetmend/improve.h>

namespace tetmend::python {

namespace {

std::string text_of(const py::handle& object) {
  return py::str(object);
}

[[noreturn]] void refuse_type(const std::string& name, const py::array& array, const char* wanted) {
  throw Error(name + " has type " + text_of(array.dtype()) + ", but " + wanted + " are wanted");
}

void check_shape(const std::string& name, const py::array& array, py::ssize_t columns) {
  if (array.ndim() == 2 && array.shape(1) == columns) return;
  throw Error(name + " has shape " + text_of(array.attr("shape")) + ", but (n, " +
              std::to_string(columns) + ") is wanted");
}

void check_length(const std::string& name, const py::array& array) {
  if (array.ndim() == 1) return;
  throw Error(name + " has shape " + text_of(array.attr("shape")) + ", but (n,) is wanted");
}

bool is_native(const py::array& array) {
  return array.dtype().attr("isnative").cast<bool>();
}

/// Calls `work` with the array as one of a C++ type of integers. Small types are widened first.
template <class Work>
void with_integers(const std::string& name, const py::array& array, const Work& work) {
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u') refuse_type(name, array, "integers");
  if (is_native(array) && array.itemsize() == 4) {
    if (kind == 'i') return work(py::array_t<std::int32_t>(array));
    return work(py::array_t<std::uint32_t>(array));
  }
  if (kind == 'u' && array.itemsize() == 8) return work(py::array_t<std::uint64_t>(array));
  return work(py::array_t<std::int64_t>(array));
}

template <class Integer>
bool is_index(Integer number, std::size_t count) {
  if constexpr (std::is_signed_v<Integer>) {
    if (number < 0) return false;
  }
  return static_cast<std::uint64_t>(number) < count;
}

/// @param place "[7, 2]"
template <class Integer>
[[noreturn]] void refuse_index(const std::string& name, const std::string& place, Integer number,
                               std::size_t count, const char* of) {
  std::string text = name + place + " is " + std::to_string(number);
  if (std::is_signed_v<Integer> && static_cast<std::int64_t>(number) < 0) {
    throw Error(text + ", but numbers begin with 0");
  }
  std::string things = of;
  if (count == 1) things.pop_back();  // one point
  // One too many is what numbers from 1 look like.
  const bool is_next = static_cast<std::uint64_t>(number) == count && count > 0;
  throw Error(text + ", but there " + (count == 1 ? "is " : "are ") + std::to_string(count) + " " +
              things + (is_next ? ", numbered from 0" : ""));
}

std::string place_of(py::ssize_t i) {
  return fmt::format("[{}]", i);
}
std::string place_of(py::ssize_t i, py::ssize_t k) {
  return fmt::format("[{}, {}]", i, k);
}

template <class Value>
DataArray::Values copied(const py::array& values) {
  const auto* const first = static_cast<const Value*>(values.data());
  return std::vector<Value>(first, first + values.size());
}

}  // namespace

std::vector<std::array<double, 3>> read_points(const py::array& points) {
  const char kind = points.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') refuse_type("points", points, "real numbers");
  check_shape("points", points, 3);
  if (points.shape(0) >= std::numeric_limits<std::int32_t>::max()) {
    throw Error("points: more than 2^31 - 1");
  }
  const py::array_t<double> numbers(points);  // the same, if it is of doubles already
  const auto given = numbers.unchecked<2>();
  std::vector<std::array<double, 3>> made(static_cast<std::size_t>(points.shape(0)));
  for (py::ssize_t i = 0; i < given.shape(0); ++i) {
    for (py::ssize_t k = 0; k < 3; ++k) {
      const double x = given(i, k);
      if (!std::isfinite(x)) {
        throw Error("points" + place_of(i, k) + " is " +
                    (std::isnan(x) ? "nan"
                     : x > 0       ? "inf"
                                   : "-inf"));
      }
      made[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = x;
    }
  }
  return made;
}

template <std::size_t N>
std::vector<std::array<std::uint32_t, N>> read_elements(const char* name, const py::array& elements,
                                                        std::size_t points) {
  std::vector<std::array<std::uint32_t, N>> made;
  with_integers(name, elements, [&](const auto& numbers) {
    check_shape(name, elements, N);
    const auto given = numbers.template unchecked<2>();
    made.resize(static_cast<std::size_t>(given.shape(0)));
    for (py::ssize_t i = 0; i < given.shape(0); ++i) {
      for (py::ssize_t k = 0; k < static_cast<py::ssize_t>(N); ++k) {
        const auto number = given(i, k);
        if (!is_index(number, points)) refuse_index(name, place_of(i, k), number, points, "points");
        made[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
            static_cast<std::uint32_t>(number);
      }
    }
  });
  return made;
}
template std::vector<std::array<std::uint32_t, 2>> read_elements<2>(const char*, const py::array&,
                                                                    std::size_t);
template std::vector<std::array<std::uint32_t, 3>> read_elements<3>(const char*, const py::array&,
                                                                    std::size_t);
template std::vector<std::array<std::uint32_t, 4>> read_elements<4>(const char*, const py::array&,
                                                                    std::size_t);
template std::vector<std::array<std::uint32_t, 10>> read_elements<10>(const char*, const py::array&,
                                                                      std::size_t);

std::vector<std::uint32_t> read_indices(const std::string& name, const py::array& indices,
                                        std::size_t count, const char* of) {
  std::vector<std::uint32_t> made;
  with_integers(name, indices, [&](const auto& numbers) {
    check_length(name, indices);
    const auto given = numbers.template unchecked<1>();
    made.resize(static_cast<std::size_t>(given.shape(0)));
    for (py::ssize_t i = 0; i < given.shape(0); ++i) {
      if (!is_index(given(i), count)) refuse_index(name, place_of(i), given(i), count, of);
      made[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(given(i));
    }
  });
  return made;
}

std::vector<std::int32_t> read_labels(const std::string& name, const py::array& labels,
                                      std::size_t count) {
  std::vector<std::int32_t> made;
  with_integers(name, labels, [&](const auto& numbers) {
    check_length(name, labels);
    const auto given = numbers.template unchecked<1>();
    if (static_cast<std::size_t>(given.shape(0)) != count) {
      throw Error(name + " has " + std::to_string(given.shape(0)) + " numbers, but " +
                  std::to_string(count) + " are wanted");
    }
    made.resize(count);
    for (py::ssize_t i = 0; i < given.shape(0); ++i) {
      if (!std::in_range<std::int32_t>(given(i))) {
        throw Error(name + place_of(i) + " is " + std::to_string(given(i)) +
                    ", which is no integer of 32 bits");
      }
      made[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(given(i));
    }
  });
  return made;
}

DataArray read_data(const std::string& name, const py::array& values) {
  DataArray made;
  made.name = name;
  made.components = static_cast<std::size_t>(values.shape(1));
  const bool is_real = values.dtype().kind() == 'f';
  const bool is_long = values.itemsize() == 8;
  if (!is_native(values) || (!is_real && values.dtype().kind() != 'i') ||
      (!is_long && values.itemsize() != 4)) {
    refuse_type(name, values, "numbers of 32 or 64 bits");
  }
  if (is_real) {
    made.values = is_long ? copied<double>(values) : copied<float>(values);
  } else {
    made.values = is_long ? copied<std::int64_t>(values) : copied<std::int32_t>(values);
  }
  return made;
}

py::array view(const py::dtype& type, std::vector<py::ssize_t> shape, const void* first,
               const py::handle& owner) {
  py::array made(type, std::move(shape), first, owner);
  made.attr("flags").attr("writeable") = false;
  return made;
}

py::array view(std::span<const std::int32_t> labels, const py::handle& owner) {
  return view(py::dtype::of<std::int32_t>(), {static_cast<py::ssize_t>(labels.size())},
              labels.data(), owner);
}

py::str to_text(std::string_view bytes) {
  const auto size = static_cast<py::ssize_t>(bytes.size());
  PyObject* text = PyUnicode_DecodeUTF8(bytes.data(), size, nullptr);
  if (text == nullptr) {
    PyErr_Clear();
    text = PyUnicode_DecodeLatin1(bytes.data(), size, nullptr);
  }
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

py::list to_texts(const std::vector<std::string>& lines) {
  py::list made;
  for (const std::string& line : lines) made.append(to_text(line));
  return made;
}

py::array to_array(std::vector<std::uint32_t>&& map) {
  static_assert(kGone == 0xFFFFFFFF);  // -1 as int32
  auto kept = std::make_unique<std::vector<std::uint32_t>>(std::move(map));
  const auto* const numbers = kept.get();
  const py::capsule owner(kept.release(), [](void* memory) {
    const std::unique_ptr<std::vector<std::uint32_t>> last(
        static_cast<std::vector<std::uint32_t>*>(memory));
  });
  return {py::dtype::of<std::int32_t>(),
          {static_cast<py::ssize_t>(numbers->size())},
          numbers->data(),
          owner};
}

}  // namespace tetmend::python
