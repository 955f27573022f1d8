// SPDX-License-Identifier: MIT
// Arrays of numpy in, checked and copied once, and out, without a copy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <tetmend/mesh.h>

namespace tetmend::python {

namespace py = pybind11;

/// (n, 3), real. @throws Error "points[5, 1] is nan"
std::vector<std::array<double, 3>> read_points(const py::array& points);

/// (n, N) of integers, each less than `points`.
/// @throws Error "tets[7, 2] is 12, but there are 12 points"
template <std::size_t N>
std::vector<std::array<std::uint32_t, N>> read_elements(const char* name, const py::array& elements,
                                                        std::size_t points);

/// (n,) of integers less than `points`.
std::vector<std::uint32_t> read_indices(const std::string& name, const py::array& indices,
                                        std::size_t count, const char* of);

/// (n,) of 32-bit integers, one for each of `count` elements.
std::vector<std::int32_t> read_labels(const std::string& name, const py::array& labels,
                                      std::size_t count);

/// (n, components) of int32, int64, float32 or float64, contiguous.
DataArray read_data(const std::string& name, const py::array& values);

/// A read-only view of memory that `owner` keeps alive.
py::array view(const py::dtype& type, std::vector<py::ssize_t> shape, const void* first,
               const py::handle& owner);

/// Vertex numbers, all below 2^31, as int32.
template <std::size_t N>
py::array view(std::span<const std::array<std::uint32_t, N>> elements, const py::handle& owner) {
  return view(py::dtype::of<std::int32_t>(), {static_cast<py::ssize_t>(elements.size()), N},
              elements.data(), owner);
}
py::array view(std::span<const std::int32_t> labels, const py::handle& owner);

/// A name or message of any bytes: those that are no UTF-8 are letters of Latin-1.
py::str to_text(std::string_view bytes);
py::list to_texts(const std::vector<std::string>& lines);

/// Of a map: new numbers, or -1 for what is gone. Takes the memory of the map.
py::array to_array(std::vector<std::uint32_t>&& map);

}  // namespace tetmend::python
