// SPDX-License-Identifier: MIT
// Counts of MPI 3.1 are ints: whatever may be longer is cut. An error of MPI itself ends all ranks.
#include "mpi/mpi_ranks.h"

#include <algorithm>
#include <utility>

namespace tetmend::mpi {

MpiRanks::MpiRanks(MPI_Comm ranks, std::size_t most)
    : most_(std::clamp<std::size_t>(most, sizeof(std::int64_t), std::size_t{1} << 30)) {
  MPI_Comm_dup(ranks, &ranks_);
  int count = 1;
  int number = 0;
  MPI_Comm_size(ranks_, &count);
  MPI_Comm_rank(ranks_, &number);
  count_ = static_cast<std::size_t>(count);
  number_ = static_cast<std::size_t>(number);
}

MpiRanks::~MpiRanks() {
  MPI_Comm_free(&ranks_);
}

std::vector<std::int64_t> MpiRanks::sizes_from_all(std::int64_t mine) const {
  std::vector<std::int64_t> sizes(count_);
  MPI_Allgather(&mine, 1, MPI_INT64_T, sizes.data(), 1, MPI_INT64_T, ranks_);
  return sizes;
}

/// In rounds, in each of which a rank gives so little that all of it together can be counted.
std::vector<std::string> MpiRanks::gather(std::string_view mine) {
  const std::vector<std::int64_t> sizes = sizes_from_all(static_cast<std::int64_t>(mine.size()));
  const std::int64_t most = *std::max_element(sizes.begin(), sizes.end());
  const auto at_once =
      static_cast<std::int64_t>(std::max<std::size_t>(1, std::min(most_, (1U << 30) / count_)));
  std::vector<std::string> all(count_);
  std::vector<int> counts(count_);
  std::vector<int> places(count_);
  std::string round;
  for (std::int64_t begin = 0; begin < most; begin += at_once) {
    int total = 0;
    for (std::size_t r = 0; r < count_; ++r) {
      counts[r] = static_cast<int>(std::clamp<std::int64_t>(sizes[r] - begin, 0, at_once));
      places[r] = total;
      total += counts[r];
    }
    round.resize(static_cast<std::size_t>(total));
    const char* from = counts[number_] > 0 ? mine.data() + begin : nullptr;
    MPI_Allgatherv(from, counts[number_], MPI_BYTE, round.data(), counts.data(), places.data(),
                   MPI_BYTE, ranks_);
    for (std::size_t r = 0; r < count_; ++r) {
      all[r].append(round, static_cast<std::size_t>(places[r]),
                    static_cast<std::size_t>(counts[r]));
    }
  }
  return all;
}

void MpiRanks::add(std::span<std::int64_t> sums) {
  const std::size_t at_once = most_ / sizeof(std::int64_t);
  for (std::size_t begin = 0; begin < sums.size(); begin += at_once) {
    const auto count = static_cast<int>(std::min(at_once, sums.size() - begin));
    MPI_Allreduce(MPI_IN_PLACE, sums.data() + begin, count, MPI_INT64_T, MPI_SUM, ranks_);
  }
}

std::vector<std::string> MpiRanks::exchange(std::vector<std::string> to) {
  std::vector<std::int64_t> sent(count_);
  std::vector<std::int64_t> coming(count_);
  for (std::size_t r = 0; r < count_; ++r) sent[r] = static_cast<std::int64_t>(to[r].size());
  MPI_Alltoall(sent.data(), 1, MPI_INT64_T, coming.data(), 1, MPI_INT64_T, ranks_);
  std::vector<std::string> came(count_);
  came[number_] = std::move(to[number_]);
  std::vector<MPI_Request> requests;
  // Messages between two ranks arrive in the order in which they were sent.
  const auto in_parts = [&](std::string& bytes, const auto& pass) {
    for (std::size_t begin = 0; begin < bytes.size(); begin += most_) {
      const auto size = static_cast<int>(std::min(most_, bytes.size() - begin));
      pass(bytes.data() + begin, size, &requests.emplace_back());
    }
  };
  for (std::size_t r = 0; r < count_; ++r) {
    if (r == number_) continue;
    came[r].resize(static_cast<std::size_t>(coming[r]));
    in_parts(came[r], [&](char* data, int size, MPI_Request* request) {
      MPI_Irecv(data, size, MPI_BYTE, static_cast<int>(r), 0, ranks_, request);
    });
  }
  for (std::size_t step = 1; step < count_; ++step) {
    const std::size_t r = (number_ + step) % count_;  // not all to the same one at first
    in_parts(to[r], [&](char* data, int size, MPI_Request* request) {
      MPI_Isend(data, size, MPI_BYTE, static_cast<int>(r), 0, ranks_, request);
    });
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return came;
}

}  // namespace tetmend::mpi
