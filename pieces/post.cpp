// SPDX-License-Identifier: MIT
#include "pieces/post.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "pieces/bytes.h"

namespace tetmend::pieces {

Post::Post(Shelf& shelf, Ranks& ranks, std::vector<std::uint32_t> owners, std::string name)
    : shelf_(shelf),
      ranks_(ranks),
      owners_(std::move(owners)),
      name_(std::move(name)),
      to_(ranks.count()) {}

std::string Post::name_of(std::size_t address) const {
  return fmt::format("{}-{}", name_, address);
}

void Post::send(std::uint64_t source, std::size_t address, std::string_view message) {
  std::string bytes;
  put(source, bytes);
  put(std::uint64_t{message.size()}, bytes);
  bytes += message;
  if (has(address)) {
    shelf_.append(name_of(address), std::move(bytes));
    return;
  }
  std::string& to = to_[owners_[address]];
  put(std::uint64_t{address}, to);
  put(std::uint64_t{bytes.size()}, to);
  to += bytes;
}

void Post::deliver() {
  if (ranks_.count() == 1) return;
  for (const std::string& from :
       ranks_.exchange(std::exchange(to_, std::vector<std::string>(ranks_.count())))) {
    for (std::string_view rest = from; !rest.empty();) {
      std::uint64_t address = 0;
      std::uint64_t size = 0;
      pieces::take(rest, address);
      pieces::take(rest, size);
      shelf_.append(name_of(address), std::string(take_front(rest, size)));
    }
  }
}

void Post::send_by_address(const Post& other,
                           const std::function<void(std::size_t address)>& send_for) {
  std::vector<std::size_t> mine;
  for (std::size_t address = 0; address < other.addresses(); ++address) {
    if (other.has(address)) mine.push_back(address);
  }
  std::size_t next = 0;
  do {
    if (next < mine.size()) send_for(mine[next++]);
    deliver();
  } while (ranks_.any(next < mine.size()));
}

std::vector<std::pair<std::uint64_t, std::string>> Post::take(std::size_t address) {
  std::vector<std::pair<std::uint64_t, std::string>> messages;
  shelf_.visit(name_of(address), [&](std::string_view bytes) {
    while (!bytes.empty()) {
      auto& [source, message] = messages.emplace_back();
      pieces::take(bytes, source);
      pieces::take(bytes, message);
    }
  });
  shelf_.remove(name_of(address));
  std::sort(messages.begin(), messages.end());
  return messages;
}

}  // namespace tetmend::pieces
