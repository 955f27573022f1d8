// SPDX-License-Identifier: MIT
#include "pieces/vtu_output.h"

#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>

#include "kernel/formats/output_file.h"
#include "kernel/formats/vtu_array.h"
#include "kernel/mesh_view.h"
#include "pieces/slices.h"
#include "tests/pieces/meshes.h"

using namespace tetmend;
using namespace tetmend::pieces;

namespace {

std::string bytes_written_to(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("a .vtu file by slices has the bytes of one that is written as a whole") {
  const test::Folder folder;
  for (const bool has_point_labels : {false, true}) {
    for (const bool has_labels : {false, true}) {
      CAPTURE(has_point_labels);
      CAPTURE(has_labels);
      MeshData data = test::lattice(10);  // indices of more than a block
      if (has_point_labels) {
        for (std::size_t v = 0; v < data.points.size(); ++v) data.point_labels.push_back(v % 7);
      }
      if (!has_labels) {
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
      for (std::uint32_t part = 0; part < mesh.parts(); ++part) {
        mesh.store(part, own_part(mesh.gathered(part), mesh.state().parting, part));
        mesh.remove_gathered(part);
      }
      mesh.number_added(std::vector<std::uint64_t>(mesh.parts(), 0));
      write_vtu_slices(folder.path() / "slices.vtu", mesh);
      const Joined joined = join(mesh, data.points.size());
      write_mesh(folder.path() / "whole.vtu", MeshView(joined.data));
      const std::string written = bytes_written_to(folder.path() / "slices.vtu");
      CHECK(written.size() > 1000);
      CHECK(written == bytes_written_to(folder.path() / "whole.vtu"));
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
