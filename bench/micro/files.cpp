// SPDX-License-Identifier: MIT
// From a file to a mesh: reading of each format, and building of adjacency. Files come from the
// cache of the operating system.
#include <cstdint>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <unistd.h>

#include "bench/micro/example.h"
#include "kernel/formats/mesh_io.h"

namespace {

using namespace tetmend;
namespace fs = std::filesystem;

/// The example mesh in a format, gone at the end of the scope.
class ExampleFile {
 public:
  explicit ExampleFile(const std::string& extension)
      : path_(fs::temp_directory_path() / fmt::format("tetmend-micro-{}{}", getpid(), extension)) {
    write_mesh(path_, bench::example_data());
  }
  ~ExampleFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  ExampleFile(const ExampleFile&) = delete;
  ExampleFile& operator=(const ExampleFile&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void file_reading(benchmark::State& state, const std::string& extension) {
  const ExampleFile file(extension);
  for (auto _ : state) benchmark::DoNotOptimize(read_mesh(file.path()));
  const auto bytes = static_cast<std::int64_t>(fs::file_size(file.path()));
  state.SetBytesProcessed(state.iterations() * bytes);
}
BENCHMARK_CAPTURE(file_reading, meshb, ".meshb")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(file_reading, mesh_ascii, ".mesh")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(file_reading, vtk, ".vtk")->Unit(benchmark::kMillisecond);

void mesh_building(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(TetMesh(bench::example_data()));
  const auto tets = static_cast<std::int64_t>(bench::example_data().tets.size());
  state.SetItemsProcessed(state.iterations() * tets);
}
BENCHMARK(mesh_building)->Unit(benchmark::kMillisecond);

}  // namespace
