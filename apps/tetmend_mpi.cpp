// SPDX-License-Identifier: MIT
// tetmend-mpi: `tetmend improve` by all processes that mpirun starts.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tetmend/catalogue.h>

#include "apps/commands.h"
#include "apps/convert_pieces.h"
#include "apps/files.h"
#include "apps/help_formatter.h"
#include "apps/interruption.h"
#include "apps/standard_streams.h"
#ifdef TETMEND_HAS_HDF5
#include "mpi/hdf5_mesh.h"
#endif
#include "apps/piece_options.h"
#include "mpi/mpi_ranks.h"
#include "pieces/partitioned_files.h"
#include "platform/platform.h"

namespace tetmend::apps {
namespace {

/// MPI from its beginning to its end.
class Mpi {
 public:
  Mpi(int& argc, char**& argv) {
    int given = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &given);
  }
  ~Mpi() { MPI_Finalize(); }
  Mpi(const Mpi&) = delete;
  Mpi& operator=(const Mpi&) = delete;
};

/// For tests. 0: not set.
std::uint64_t number_of_environment(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
}

/// Longer messages are cut.
std::size_t most_bytes() {
  const std::uint64_t bytes = number_of_environment("TETMEND_MPI_MESSAGE_BYTES");
  return bytes > 0 ? bytes : mpi::MpiRanks::kMostBytes;
}

#ifdef TETMEND_HAS_HDF5
/// Of all ranks together.
class Hdf5Files final : public pieces::ArrayFiles {
 public:
  bool is_one(const std::filesystem::path& file) const override {
    return file.extension() == ".h5";
  }
  pieces::RankShare read(const std::filesystem::path& file, const std::string&) const override {
    return mpi::read_hdf5(file, MPI_COMM_WORLD);
  }
  void write(const std::filesystem::path& file, const pieces::RankShare& arrays) const override {
    mpi::write_hdf5(file, arrays, MPI_COMM_WORLD);
  }
  formats::FileSet files_written(const std::filesystem::path& file) const override {
    return {.files = mpi::files_of_hdf5(file), .numbered = {}};
  }
  bool takes(const std::filesystem::path&, pieces::RowKind, const DataArray&) const override {
    return true;
  }
};
#endif

struct ConvertOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::size_t parts = 0;
};

void add_convert_by_ranks(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = app.add_subcommand("convert", "Write a mesh in another format");
  command->add_option("IN", options->input, "Mesh to read")->required()->type_name("");
  command->add_option("OUT", options->output, "File to write")->required()->type_name("");
  add_parts_option(*command, options->parts);
  command->footer(
      R"(Vertices and tets keep their order; OUT in parts has tets in another one. Files
of HDF5 (.h5), .meshb and meshes in parts are read by all processes, each its
share; other formats by the first one alone.

Examples:
  mpirun -n 8 tetmend-mpi convert part.meshb part.h5
  mpirun -n 8 tetmend-mpi convert part.h5 part.pvtu

Exit status: 0 success, 1 a file cannot be read or written, 2 wrong usage)");
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] {
      if (options->parts > 0 && !invocation.array_files->is_in_parts(options->output)) {
        throw UsageError("--pieces: OUT is no mesh in parts");
      }
      convert_pieces(options->input, options->output, {}, invocation.array_files, options->parts,
                     *invocation.ranks);
      return kSuccess;
    };
  });
}

std::unique_ptr<CLI::App> make_parser(Invocation& invocation) {
  auto app = std::make_unique<CLI::App>(
      "tetmend-mpi improves a tetrahedral mesh in pieces, by all processes that\n"
      "mpirun starts.",
      "tetmend-mpi");
  app->set_version_flag("--version", fmt::format("tetmend-mpi {}", version()));
  app->require_subcommand(1);
  app->formatter(std::make_shared<HelpFormatter>(asks_for_short_help(invocation.arguments)));
  app->set_help_flag("-h,--help", "What is usual with -h, all with --help");
  app->footer(R"(Examples:
  mpirun -n 8 tetmend-mpi improve part.meshb -o better.meshb
  mpirun -n 64 --map-by ppr:1:node:PE=16 tetmend-mpi improve part.meshb
      -o better.meshb --threads 16 --checkpoint saved
  mpirun -n 8 tetmend-mpi adapt part.meshb --size h.lua -o finer.meshb

The mesh is divided into a piece for each 4 million tets, or as --pieces or
--memory ask; the number of processes does not show in the result. All see the
same files. Pieces lie in the memory of the processes, or below --scratch.
When a process dies the others end, and no mesh is written; with --checkpoint
the same command goes on from the last division, with any number of processes.
Files of HDF5 (.h5) are read and written by all processes together, if tetmend-mpi
was built with it; FILE.xdmf beside them is what ParaView opens. So are meshes in
parts: .pvtu with its .vtu files, and Gmsh's part_1.msh, part_2.msh... under the
name part_%d.msh. Of .meshb, .vtu and .msh each reads its share, and the first one
writes. Other formats are read and written by the first process alone.
SIGUSR1 to mpirun stops the work: the mesh is written as improved so far.

Exit status: that of tetmend improve)");
  add_improve(*app, invocation);
  add_adapt(*app, invocation);
  add_convert_by_ranks(*app, invocation);
  return app;
}

int run(int argc, char** argv, Ranks& ranks) {
  Invocation invocation;
  invocation.ranks = &ranks;
  invocation.first_vertex_id = number_of_environment("TETMEND_MPI_FIRST_VERTEX_ID");
  const pieces::PvtuFiles pvtu(ranks);
  const pieces::GmshParts gmsh(ranks);
  std::vector<const pieces::ArrayFiles*> kinds = {&pvtu, &gmsh};
#ifdef TETMEND_HAS_HDF5
  const Hdf5Files hdf5;
  kinds.push_back(&hdf5);
#endif
  const pieces::SeveralArrayFiles files(std::move(kinds));
  invocation.array_files = &files;
  invocation.arguments = platform::arguments(argc, argv);
  if (!invocation.arguments.empty()) invocation.arguments.erase(invocation.arguments.begin());
  const auto app = make_parser(invocation);
  try {
    using Words = std::vector<std::string>;
    app->parse(Words(invocation.arguments.rbegin(), invocation.arguments.rend()));  // last first
  } catch (const CLI::ParseError& error) {
    if (!ranks.is_first()) return error.get_exit_code() == 0 ? kSuccess : kWrongUsage;
    if (error.get_exit_code() == 0) return app->exit(error);  // prints help or version
    return complain(kWrongUsage, fmt::format("{} (see tetmend-mpi --help)", message_of(error)));
  }
  return invocation.action();
}

/// Ends all processes. Often all find the same mistake: the first one tells.
[[noreturn]] void fail(const Ranks& ranks, int status, std::string_view message) {
  if (!ranks.is_first()) std::this_thread::sleep_for(std::chrono::milliseconds(500));
  complain(kFailed, ranks.is_first() ? std::string(message)
                                     : fmt::format("process {}: {}", ranks.number(), message));
  MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

int run_and_catch(int argc, char** argv) {
  const Mpi mpi(argc, argv);
  mpi::MpiRanks ranks(MPI_COMM_WORLD, most_bytes());
  end_without_remains();
  try {
    return run(argc, argv, ranks);
  } catch (const UsageError& error) {
    fail(ranks, kWrongUsage, error.what());
  } catch (const std::bad_alloc&) {
    fail(ranks, kFailed, "out of memory: more pieces need less, see --pieces");
  } catch (const std::exception& error) {
    fail(ranks, kFailed, error.what());
  } catch (...) {
    fail(ranks, kFailed, "unexpected failure");
  }
}

}  // namespace
}  // namespace tetmend::apps

int main(int argc, char** argv) {
  tetmend::platform::reserve_standard_streams();
  tetmend::platform::give_back_blocks_from(1 << 20);  // see tetmend.cpp
  return tetmend::apps::run_and_catch(argc, argv);
}
