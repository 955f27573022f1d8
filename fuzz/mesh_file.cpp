// SPDX-License-Identifier: MIT
// A mesh file of a stranger: an Error of one line, or a mesh that can be built, written, and read
// again as it was. A mesh of several files is one input: before each file stands a line "==== NAME".
#include <algorithm>
#include <set>
#include <vector>

#include "fuzz/target.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "kernel/tet_mesh.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::fuzz;

namespace {

constexpr std::string_view kExtension = TETMEND_FUZZ_EXTENSION;
constexpr std::string_view kMark = "==== ";

/// Without a mark all is the file `in.EXTENSION`.
void write_files(const RamFolder& folder, std::string_view input) {
  std::set<std::filesystem::path> names = {};
  for (const auto& file : mesh_files(folder / ("in." + std::string(kExtension)))) {
    std::filesystem::remove(file);
    names.insert(file);
  }
  if (!input.starts_with(kMark)) {
    write_file(folder / ("in." + std::string(kExtension)), input);
    return;
  }
  while (input.starts_with(kMark)) {
    const std::size_t line_end = std::min(input.find('\n'), input.size());
    const auto name = folder / std::string(input.substr(kMark.size(), line_end - kMark.size()));
    input.remove_prefix(std::min(line_end + 1, input.size()));
    const std::size_t end = input.find("\n" + std::string(kMark));
    if (names.contains(name)) write_file(name, input.substr(0, end == input.npos ? end : end + 1));
    input.remove_prefix(end == input.npos ? input.size() : end + 1);
  }
}

std::vector<std::string> contents(const std::filesystem::path& file) {
  std::vector<std::string> all;
  for (const auto& part : mesh_files(file)) {
    if (std::filesystem::exists(part)) all.push_back(read_file(part));
  }
  return all;
}

/// Abaqus and CalculiX read 20 characters of a number: a longer one is rounded, and a note says so.
bool is_rounded(const std::filesystem::path& file, const MeshData& mesh) {
  const auto notes = not_written(file, mesh);
  return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("coordinates are rounded") != note.npos;
  });
}

/// What was read comes back when it is written in the same format, and the second writing has the
/// bytes of the first.
void require_round_trip(const RamFolder& folder, const MeshData& mesh) {
  // Under one name, which files that name others hold.
  const std::string name = "/mesh." + std::string(kExtension);
  const auto once = folder / ("once" + name);
  const auto twice = folder / ("twice" + name);
  for (const auto& file : {once, twice}) std::filesystem::create_directories(file.parent_path());
  try {
    write_mesh(once, mesh);
  } catch (const Error& error) {
    require_one_line(error.what());
    return;  // a variant that cannot hold it
  }
  MeshData again;
  try {
    again = read_mesh(once);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    require(false, "what was written can be read");
  }
  require(test::same_points(mesh, again) || is_rounded(once, mesh), "points come back bit for bit");
  require(mesh.tets.size() == again.tets.size(), "as many tets come back");
  // A mesh whose tets are inside out may come back right, as a whole.
  const bool turned = !mesh.tets.empty() && mesh.tets[0].vertices != again.tets[0].vertices;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    auto vertices = again.tets[t].vertices;
    if (turned) std::swap(vertices[2], vertices[3]);
    require(mesh.tets[t].vertices == vertices, "tets come back in their order");
  }
  write_mesh(twice, again);
  require(contents(once) == contents(twice), "writing what was written gives the same bytes");
}

void require_sound_mesh(MeshData mesh) {
  try {
    const TetMesh built = TetMesh::sorted(std::move(mesh));
    const std::string findings = to_string(check_integrity(built));
    if (!findings.empty()) std::fprintf(stderr, "%s\n", findings.c_str());
    require(findings.empty(), "a mesh that was built is sound");
  } catch (const Error& error) {
    require_one_line(error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const RamFolder folder;
  write_files(folder, {reinterpret_cast<const char*>(data), size});
  MeshData mesh;
  try {
    mesh = read_mesh(folder / ("in." + std::string(kExtension)));
  } catch (const Error& error) {
    require_one_line(error.what());
    require(std::string_view(error.what()).starts_with(folder.path().string()),
            "a message begins with the file");
    return 0;
  }
  require(test::extras_are_sound(mesh), "groups, arrays and elements name what is there");
  for (const std::string& note : mesh.notes) require_one_line(note);
  require_round_trip(folder, mesh);
  require_sound_mesh(std::move(mesh));
  return 0;
}
