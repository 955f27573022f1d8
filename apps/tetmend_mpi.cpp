// SPDX-License-Identifier: MIT
// tetmend-mpi: `tetmend improve` by all processes that mpirun starts.
#include <chrono>
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
#include "apps/help_formatter.h"
#include "apps/interruption.h"
#include "apps/standard_streams.h"
#ifdef TETMEND_HAS_HDF5
#include "mpi/hdf5_mesh.h"
#endif
#include "mpi/mpi_ranks.h"
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

/// For tests: longer messages are cut.
std::size_t most_bytes() {
  const char* text = std::getenv("TETMEND_MPI_MESSAGE_BYTES");
  if (text == nullptr) return mpi::MpiRanks::kMostBytes;
  const unsigned long long bytes = std::strtoull(text, nullptr, 10);
  return bytes > 0 ? bytes : mpi::MpiRanks::kMostBytes;
}

#ifdef TETMEND_HAS_HDF5
/// Of all ranks together.
class Hdf5Files final : public pieces::ArrayFiles {
 public:
  bool is_one(const std::filesystem::path& file) const override {
    return file.extension() == ".h5";
  }
  pieces::RankArrays read(const std::filesystem::path& file) const override {
    return mpi::read_hdf5(file, MPI_COMM_WORLD);
  }
  void write(const std::filesystem::path& file, const pieces::RankArrays& arrays) const override {
    mpi::write_hdf5(file, arrays, MPI_COMM_WORLD);
  }
};
#endif

std::unique_ptr<CLI::App> make_parser(Invocation& invocation) {
  auto app = std::make_unique<CLI::App>(
      "tetmend-mpi improves a tetrahedral mesh in pieces, by all processes that\n"
      "mpirun starts.",
      "tetmend-mpi");
  app->set_version_flag("--version", fmt::format("tetmend-mpi {}", version()));
  app->require_subcommand(1);
  app->formatter(std::make_shared<HelpFormatter>());
  app->footer(R"(Examples:
  mpirun -n 8 tetmend-mpi improve part.meshb -o better.meshb
  mpirun -n 64 --map-by ppr:1:node:PE=16 tetmend-mpi improve part.meshb
      -o better.meshb --threads 16 --checkpoint saved

The mesh is divided into a piece for each 4 million tets, or as --pieces or
--memory ask; the number of processes does not show in the result. All see the
same files. Pieces lie in the memory of the processes, or below --scratch.
When a process dies the others end, and no mesh is written; with --checkpoint
the same command goes on from the last division, with any number of processes.
Files of HDF5 (.h5) are read and written by all processes together, if tetmend-mpi
was built with it; FILE.xdmf beside them is what ParaView opens.
SIGUSR1 to mpirun stops the work: the mesh is written as improved so far.

Exit status: that of tetmend improve)");
  add_improve(*app, invocation);
  return app;
}

int run(int argc, char** argv, pieces::Ranks& ranks) {
  Invocation invocation;
  invocation.ranks = &ranks;
#ifdef TETMEND_HAS_HDF5
  const Hdf5Files files;
  invocation.array_files = &files;
#endif
  invocation.arguments = platform::arguments(argc, argv);
  if (!invocation.arguments.empty()) invocation.arguments.erase(invocation.arguments.begin());
  const auto app = make_parser(invocation);
  try {
    using Words = std::vector<std::string>;
    app->parse(Words(invocation.arguments.rbegin(), invocation.arguments.rend()));  // last first
  } catch (const CLI::ParseError& error) {
    if (!ranks.is_first()) return error.get_exit_code() == 0 ? kSuccess : kWrongUsage;
    if (error.get_exit_code() == 0) return app->exit(error);  // prints help or version
    return complain(kWrongUsage, fmt::format("{} (see tetmend-mpi --help)", error.what()));
  }
  return invocation.action();
}

/// Ends all processes. Often all find the same mistake: the first one tells.
[[noreturn]] void fail(const pieces::Ranks& ranks, int status, std::string_view message) {
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
