// SPDX-License-Identifier: MIT
#include "kernel/formats/cgns_tree.h"

#include <map>
#include <utility>

#include <fmt/format.h>

namespace tetmend::formats {

std::vector<std::string> CgnsTree::nodes_below(const std::string& path) const {
  std::vector<std::string> found;
  for (const std::string& name : file_->names(path)) {
    if (!name.starts_with(' ')) found.push_back(path == "/" ? name : path + "/" + name);
  }
  return found;
}

std::vector<std::string> CgnsTree::children(const std::string& path, std::string_view wanted) {
  std::vector<std::string> found;
  for (std::string& below : nodes_below(path)) {
    if (label(below) != wanted) continue;
    see(below);
    found.push_back(std::move(below));
  }
  return found;
}

std::vector<std::int64_t> CgnsTree::integers(const std::string& path) {
  see(path);
  return file_->integers(data_of(path));
}

std::vector<double> CgnsTree::reals(const std::string& path) {
  see(path);
  return file_->reals(data_of(path));
}

DataArray::Values CgnsTree::values(const std::string& path) {
  see(path);
  return file_->values(data_of(path));
}

std::string CgnsTree::characters(const std::string& path) {
  if (!has(path)) return {};
  const std::vector<std::string> rows = file_->texts(data_of(path));
  return rows.empty() ? std::string() : rows[0];
}

std::string CgnsTree::text_below(const std::string& path, std::string_view wanted) {
  const std::vector<std::string> found = children(path, wanted);
  return found.empty() ? std::string() : characters(found[0]);
}

std::vector<std::string> CgnsTree::notes_of_the_rest() const {
  struct Rest {
    std::size_t count = 0;
    std::string first;
  };
  std::map<std::string, Rest> of_label;
  std::vector<std::string> waiting = nodes_below("/");
  while (!waiting.empty()) {
    const std::string path = std::move(waiting.back());
    waiting.pop_back();
    if (seen_.contains(path)) {
      for (std::string& below : nodes_below(path)) waiting.push_back(std::move(below));
      continue;
    }
    Rest& rest = of_label[label(path)];
    if (++rest.count == 1 || path < rest.first) rest.first = path;
  }
  std::vector<std::string> notes;
  for (const auto& [what, rest] : of_label) {
    const std::string first = in_quotes("/" + rest.first);
    notes.push_back(rest.count == 1
                        ? fmt::format("the node {} is not kept", first)
                        : fmt::format("{} nodes of type {} are not kept, the first is {}",
                                      rest.count, in_quotes(what), first));
  }
  return notes;
}

}  // namespace tetmend::formats
