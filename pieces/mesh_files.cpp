// SPDX-License-Identifier: MIT
#include "pieces/mesh_files.h"

#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "face/carry.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/mesh_view.h"
#include "pieces/bytes.h"
#include "pieces/slices.h"

namespace tetmend::pieces {

InputMesh::InputMesh(const std::filesystem::path& file, Ranks& ranks, const ArrayFiles* files)
    : slices_(MeditSlices::open(file)) {
  if (files != nullptr && files->is_one(file)) {
    arrays_ = files->read(file);
    const ArrayCounts counts = count_all(*arrays_, ranks);
    tets_ = counts.tets;
    vertices_ = counts.points;
    return;
  }
  if (slices_) {
    tets_ = slices_->counts().tets;
    vertices_ = slices_->counts().vertices;
    return;
  }
  std::string counts;
  if (ranks.is_first()) {
    data_ = read_mesh(file);
    if (face::holds_more(data_) || !data_.mid_nodes.empty()) {
      throw Error(
          fmt::format("{}: holds more than tets, labels and constraints, which needs the "
                      "whole mesh in memory",
                      file.string()));
    }
    put(std::uint64_t{data_.tets.size()}, counts);
    put(std::uint64_t{data_.points.size()}, counts);
  }
  const std::vector<std::string> all = ranks.gather(counts);
  std::string_view rest = all.front();
  take(rest, tets_);
  take(rest, vertices_);
}

void InputMesh::add_to(DividedMesh& mesh, std::size_t pieces) {
  if (arrays_) {
    add_arrays(*arrays_, mesh);
    arrays_.reset();
    return;
  }
  if (slices_) {
    slices_->add_to(mesh, std::min<std::size_t>(kTetsOfSlice, 1 + tets_ / pieces));
  } else if (mesh.ranks().is_first()) {
    add_slices(data_, {}, mesh);
    data_ = {};
  }
  mesh.end_slices();
}

void write_pieces(const std::filesystem::path& file, DividedMesh& mesh, std::uint64_t vertices,
                  const ArrayFiles* files) {
  if (files != nullptr && files->is_one(file)) return files->write(file, take_arrays(mesh));
  if (file.extension() == ".meshb") return write_medit_slices(file, mesh);
  mesh.bring_to_first();
  if (mesh.ranks().is_first()) {
    const Joined joined = join(mesh, vertices);
    write_mesh(file, MeshView(joined.data));
  }
  mesh.ranks().meet();
}

void check_for_files(const Options& options) {
  const auto refuse = [](bool given, const char* name, std::string_view option) {
    if (!given) return;
    throw OptionError(name, fmt::format("{}: needs the whole mesh in memory", option));
  };
  refuse(!options.protect.empty(), "protect", "protect");
  refuse(!options.only.empty(), "only", "only");
  refuse(!options.surface.empty() && options.surface != "fixed", "surface", "surface");
  refuse(options.keep_size, "keep_size", "keep-size");
  refuse(!options.conserve.empty(), "conserve", "conserve");
  refuse(options.ignore_interior, "ignore_interior", "ignore-interior");
  refuse(!options.trace.empty(), "trace", "trace");
  refuse(options.check_operators, "check_operators", "check-operators");
}

void check_before(const Figures& before, const Options& options,
                  const std::filesystem::path& file) {
  const auto fail = [&](std::string_view what) {
    throw Error(fmt::format("{}: {}", file.string(), what));
  };
  if (before.peculiar > 0) {
    fail("some tets are inverted, flat or turned round, which needs the whole mesh in memory");
  }
  if (before.layer_tets > 0 && options.layers == Layers::keep) {
    fail(
        "has boundary layers: keeping them needs the whole mesh in memory; 'layers improve' "
        "gives them up");
  }
}

void check_after(const Figures& before, const Figures& after, Result& result) {
  result.before = before.statistics;
  result.not_positive_before = before.not_positive;
  result.after = after.statistics;
  result.surface_fingerprint = after.surface;
  result.not_positive_after = after.not_positive;
  constexpr double kMostVolumeChange = 1e-9;
  const bool fits = after.surface == before.surface &&
                    result.after.boundary_triangles == result.before.boundary_triangles &&
                    result.not_positive_after <= result.not_positive_before &&
                    result.volume_change() <= kMostVolumeChange;
  if (!fits) throw Error("the pieces do not fit: this is a bug of tetmend, please report it");
}

std::string why_as_it_was(const Result& result) {
  return fmt::format("the mesh is as it was: at the end there was {}",
                     fmt::join(result.worse(), "; "));
}

OptionTexts texts_of(const Options& options) {
  OptionTexts texts;
  const auto add = [&](std::string_view name, std::string value) {
    if (!value.empty()) texts.emplace_back(name, std::move(value));
  };
  const std::filesystem::path schedule = options.schedule;
  if (!options.script.empty()) {
    add("script", options.script);
  } else if (schedule.extension() == ".lua") {
    std::ifstream in(schedule, std::ios::binary);
    add("script", {std::istreambuf_iterator<char>(in), {}});
    if (in.bad() || !in.is_open()) throw Error(fmt::format("cannot read {}", schedule.string()));
  } else {
    add("schedule", options.schedule);
  }
  for (const auto& [name, value] : options.set) add("set", fmt::format("{}={}", name, value));
  for (const std::filesystem::path& plugin : options.plugin) {
    add("plugin", std::filesystem::absolute(plugin).string());
  }
  add("goal", fmt::format("{},{}", options.goal.min_angle, options.goal.max_angle));
  add("measure", options.measure);
  add("layers", options.layers == Layers::keep ? "keep" : "improve");
  add("tets", options.tets);
  return texts;
}

}  // namespace tetmend::pieces
