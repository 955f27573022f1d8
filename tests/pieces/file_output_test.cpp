// SPDX-License-Identifier: MIT
// Files that are written piece by piece are those that are written as a whole.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>

#include "kernel/formats/output_file.h"
#include "kernel/formats/vtu_array.h"
#include "kernel/mesh_view.h"
#include "pieces/gmsh_output.h"
#include "pieces/medit_slices.h"
#include "pieces/slices.h"
#include "pieces/vtu_output.h"
#include "tests/pieces/meshes.h"

using namespace tetmend;
using namespace tetmend::pieces;

namespace {

std::string bytes_written_to(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("a file that is written piece by piece has the bytes of one that is written as a whole") {
  const test::Folder folder;
  enum class Labels { none, some, many };
  for (const bool has_point_labels : {false, true}) {
    for (const Labels labels : {Labels::none, Labels::some, Labels::many}) {
      CAPTURE(has_point_labels);
      CAPTURE(static_cast<int>(labels));
      MeshData data = test::lattice(10);  // indices of more than a block of a .vtu file
      if (has_point_labels) {
        for (std::size_t v = 0; v < data.points.size(); ++v)
          data.point_labels.push_back(Label(v % 7));
      }
      for (std::uint32_t v = 0; v < 200; v += 3) data.edges.push_back({{v, v + 1}, Label(v % 5)});
      for (std::size_t t = 0; labels == Labels::many && t < data.tets.size(); ++t) {
        data.tets[t].label = static_cast<Label>(t / 40 % 17) - 4;
      }
      if (labels == Labels::none) {
        for (MeshData::Tet& tet : data.tets) tet.label = 0;
        data.triangles.clear();
        data.edges.clear();
      }
      MemoryShelf shelf;
      OneRank ranks;
      DividedMesh mesh(shelf, ranks, data.points.size());
      add_slices(data, {}, mesh);
      mesh.end_slices();
      mesh.divide(5, 0);
      test::store_idly(mesh);
      const Joined joined = join(mesh, data.points.size());
      const auto check = [&](const std::string& ending, std::string_view variant, auto write) {
        CAPTURE(ending);
        const std::filesystem::path slices = folder.path() / ("slices" + ending);
        const std::filesystem::path whole = folder.path() / ("whole" + ending);
        write(slices);
        MeshView view(joined.data);
        view.set_variant(variant);
        write_mesh(whole, view);
        CHECK(bytes_written_to(slices).size() > 1000);
        CHECK(bytes_written_to(slices) == bytes_written_to(whole));
      };
      check(".meshb", "", [&](const auto& file) { write_medit_slices(file, mesh); });
      check(".vtu", "", [&](const auto& file) { write_vtu_slices(file, mesh); });
      check(".msh", "", [&](const auto& file) { write_gmsh_slices(file, mesh, true); });
      check(".msh", "4.1 ASCII", [&](const auto& file) { write_gmsh_slices(file, mesh, false); });
    }
  }
}

TEST_CASE("in which portions the bytes of an array come does not show") {
  const test::Folder folder;
  std::string content;
  for (unsigned i = 0; i < 400'000; ++i) content += static_cast<char>(i * i >> 7);
  const auto write = [&](const std::string& name, std::size_t portion) {
    OutputFile out(folder.path() / name);
    formats::VtuArray array("a<b", "UInt8", 1);
    for (std::size_t i = 0; i < content.size(); i += portion) {
      array.measure(std::string_view(content).substr(i, portion));
    }
    array.begin(out);
    for (std::size_t i = 0; i < content.size(); i += portion) {
      array.write(std::string_view(content).substr(i, portion), out);
    }
    array.end(out);
    out.commit();
    return bytes_written_to(folder.path() / name);
  };
  const std::string whole = write("whole", content.size());
  CHECK(whole.find("a&lt;b") != std::string::npos);
  CHECK(write("odd", 1'001) == whole);
  CHECK(write("blocks", std::size_t{1} << 17) == whole);
}
