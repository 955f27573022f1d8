// SPDX-License-Identifier: MIT
// Ranks that are processes of MPI.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mpi.h>
#include <tetmend/distributed.h>

namespace tetmend::mpi {

/// Needs no more than MPI 3.1. It is compiled in other programs, too: see bindings/petsc. Calls come from one thread at a time.
class MpiRanks final : public Ranks {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

  /// Has a communicator of its own, so its messages meet no others.
  /// @param most bytes of one message; longer ones are cut
  explicit MpiRanks(MPI_Comm ranks, std::size_t most = kMostBytes);
  ~MpiRanks() override;
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  std::size_t count() const override { return count_; }
  std::size_t number() const override { return number_; }
  std::vector<std::string> gather(std::string_view mine) override;
  void add(std::span<std::int64_t> sums) override;
  std::vector<std::string> exchange(std::vector<std::string> to) override;

 private:
  std::vector<std::int64_t> sizes_from_all(std::int64_t mine) const;

  MPI_Comm ranks_ = MPI_COMM_NULL;
  std::size_t most_;
  std::size_t count_ = 1;
  std::size_t number_ = 0;
};

}  // namespace tetmend::mpi
