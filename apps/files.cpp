// SPDX-License-Identifier: MIT
// What the subcommands do with files: check their names early, say what loading a mesh found.
#include "apps/files.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <tetmend/io.h>

#include "apps/commands.h"
#include "apps/standard_streams.h"
#include "explain/json_text.h"
#include "kernel/formats/harmless_notes.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/packed_file.h"
#include "kernel/formats/pending_file.h"
#include "kernel/formats/run_files.h"
#include "kernel/formats/standard_stream.h"
#include "kernel/nearest_word.h"
#include "kernel/printable.h"
#include "pieces/rank_share.h"
#include "pieces/run_folder.h"
#include "platform/platform.h"

namespace tetmend::apps {

void check_mesh_extension(const std::filesystem::path& file) {
  std::vector<std::string_view> valid;
  const bool is_packed = formats::has_packed_name(file);
  for (const FileFormat& format : file_formats()) {
    if (!is_packed || format.name != "TetGen") valid.push_back(format.extension);
  }
  check_extension(is_packed ? file.parent_path() / file.stem() : file, valid);
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string lower = file.extension().string();
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

void check_extension(const std::filesystem::path& file, std::span<const std::string_view> valid) {
  const std::string given = file.extension().string();
  if (std::find(valid.begin(), valid.end(), lower_extension(file)) != valid.end()) return;
  const std::string names = fmt::format("{}", fmt::join(valid, ", "));
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw UsageError(fmt::format("{} is a folder: expected a file, {}{}", file.string(),
                                 valid.size() > 1 ? "one of " : "", names));
  }
  throw UsageError(fmt::format("{}: the extension '{}' is not known here: expected {}{}{}",
                               file.string(), given, valid.size() > 1 ? "one of " : "", names,
                               guess_of(given, names)));
}

void add_format_option(CLI::App& command, std::string& format) {
  command
      .add_option(
          "--format", format,
          "What '-', standard input or output in place of\na file, holds: an extension; two "
          "where both are\n'-' and differ (msh,vtu)")
      ->type_name("EXT[,EXT]");
}

void name_streams(const std::string& format, std::filesystem::path& input,
                  std::filesystem::path* output) {
  const std::size_t comma = format.find(',');
  const std::string first = format.substr(0, comma);
  const std::string second = comma == std::string::npos ? first : format.substr(comma + 1);
  const auto name = [](std::filesystem::path& file, const std::string& extension) {
    if (file != "-") return;
    if (extension.empty()) throw UsageError("'-' needs --format, such as --format msh");
    file = extension.starts_with(".") ? "-" + extension : "-." + extension;
    check_mesh_extension(file);
  };
  name(input, first);
  if (output != nullptr) name(*output, second);
}

std::string shown(const std::filesystem::path& file) {
  return formats::is_standard_stream(file) ? "standard input" : file.string();
}

std::FILE* stream_beside(const std::filesystem::path& output) {
  return formats::is_standard_stream(output) ? stderr : stdout;
}

namespace {

bool has_parts(const std::filesystem::path& file, const pieces::ArrayFiles* known) {
  return known != nullptr && known->is_one(file);
}

formats::FileSet files_written(const NamedFile& named, const pieces::ArrayFiles* known) {
  switch (named.kind) {
    case NamedFile::Kind::run_folder:
      return pieces::RunFolder(named.file).files();
    case NamedFile::Kind::mesh:
      return has_parts(named.file, known)
                 ? known->files_written(named.file)
                 : formats::FileSet{.files = mesh_files(named.file), .numbered = {}};
    case NamedFile::Kind::plain:
      break;
  }
  return {.files = {named.file}, .numbered = {}};
}

formats::FileSet files_read(const NamedFile& named, const pieces::ArrayFiles* known) {
  if (named.kind != NamedFile::Kind::mesh) return files_written(named, known);
  return has_parts(named.file, known)
             ? known->files_read(named.file)
             : formats::FileSet{.files = source_files(named.file), .numbered = {}};
}

/// A mesh may take the place of one of the same format alone: through a link from b.vtk to a.mesh
/// the file a.mesh would get what no reader of .mesh understands.
std::string replaceable(const NamedFile& named, const pieces::ArrayFiles* known) {
  if (!named.in_place) return {};
  return has_parts(named.file, known) ? "parts" + lower_extension(named.file)
                                      : format_name(named.file);
}

void check_writable(const NamedFile& output) {
  const std::filesystem::path& file = output.file;
  if (output.kind == NamedFile::Kind::mesh) formats::check_packing_to_write(file);
  if (output.kind == NamedFile::Kind::run_folder || formats::is_standard_stream(file)) return;
  const bool is_mesh = output.kind == NamedFile::Kind::mesh;
  for (const auto& each : is_mesh ? mesh_files(file) : std::vector<std::filesystem::path>{file}) {
    std::error_code error;
    // Of several files, not all need be written.
    if (each != file && !std::filesystem::exists(each, error)) continue;
    const formats::PendingFile probe(each);  // vanishes without commit()
    for (const std::string& text : probe.notes()) {
      say(stderr, fmt::format("note: {}: {}\n", printable(each.string()), text));
    }
  }
}

}  // namespace

void check_distinct(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs,
                    const pieces::ArrayFiles* known) {
  formats::RunFiles files;
  for (const NamedFile& input : inputs) {
    if (input.file.empty()) continue;
    files.read({input.option, files_read(input, known), replaceable(input, known),
                files_written(input, known)});
  }
  for (const NamedFile& output : outputs) {
    if (output.file.empty()) continue;
    files.write({output.option, files_written(output, known), replaceable(output, known)});
  }
  if (const auto clash = files.clash()) {
    throw UsageError(fmt::format("{}: {} and {} would be the same file", clash->file.string(),
                                 clash->option, clash->output));
  }
}

void prepare_files(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs,
                   const pieces::ArrayFiles* known) {
  platform::ignore_broken_pipes();
  check_distinct(inputs, outputs, known);
  for (const NamedFile& output : outputs) {
    if (!output.file.empty()) check_writable(output);
  }
}

nlohmann::json printable_for(std::string_view where, const nlohmann::json& json) {
  for (const std::string& text : explain::changed_texts(json)) {
    say(stderr, fmt::format("note: {}: '{}' is written for a name that is no plain text\n", where,
                            printable(text)));
  }
  return explain::printable_json(json);
}

void print_json(const nlohmann::json& json) {
  say(stdout, printable_for("standard output", json).dump(2) + '\n');
}

void add_carry_options(CLI::App& command, CarryOptions& options) {
  command
      .add_option("--label-array", options.label_array,
                  "Array over cells that holds the labels; default: by\nits name, or the only one "
                  "of integers")
      ->type_name("NAME");
  command
      .add_option("--variant", options.variant,
                  "How OUT is written; default: as IN.\n.msh: '2.2 ASCII', '2.2 binary', '4.1 "
                  "ASCII',\n'4.1 binary'; .vtk, .vtu: ASCII, binary;\n.ele: 'from 0', 'from 1'; "
                  ".inp: lists, ranges;\n.bdf: short, long, free, rounded")
      ->type_name("NAME");
  command.add_flag("--strict", options.strict, "Write nothing if anything of IN would be lost");
}

void check_variant(const std::filesystem::path& output, const CarryOptions& options) {
  const auto known = file_variants(output);
  if (options.variant.empty() ||
      std::find(known.begin(), known.end(), options.variant) != known.end()) {
    return;
  }
  const std::string names = fmt::format("{}", fmt::join(known, ", "));
  throw UsageError(fmt::format("--variant: '{}' is none of {}: expected {}{}", options.variant,
                               output.string(),
                               known.empty() ? "nothing, there is only one" : "one of " + names,
                               guess_of(options.variant, names)));
}

void tell_lost(const std::filesystem::path& input, const std::vector<std::string>& lost,
               const CarryOptions& options, std::vector<std::string>& notes) {
  for (const std::string& text : lost) {
    say(stderr, fmt::format("note: {}: {}\n", printable(shown(input)), printable(text)));
  }
  const auto losses = std::count_if(lost.begin(), lost.end(), [&](const std::string& text) {
    return !formats::loses_nothing(text, options.replaces_tets);
  });
  if (options.strict && losses > 0) {
    throw Error(fmt::format("{}: {} would be lost: nothing is written", shown(input),
                            losses == 1 ? "something" : fmt::format("{} things", losses)));
  }
  notes.insert(notes.end(), lost.begin(), lost.end());
}

Mesh load_for(const std::filesystem::path& input, const std::filesystem::path& output, int threads,
              const CarryOptions& options, std::vector<std::string>& notes) {
  Mesh mesh = load(input, threads, options.label_array);
  std::vector<std::string> lost = mesh.notes();
  for (std::string& text : not_saved(output, mesh, options.variant))
    lost.push_back(std::move(text));
  tell_lost(input, lost, options, notes);
  for (const std::string& text : remarks_on_saving(output, mesh, options.variant)) {
    say(stderr, fmt::format("note: {}: {}\n", printable(shown(output)), printable(text)));
  }
  return mesh;
}

std::string mesh_format_list() {
  std::string text;
  std::string_view last;
  for (const FileFormat& format : file_formats()) {
    if (format.name != last)
      text += fmt::format("{}  {:<16}", text.empty() ? "" : "\n", format.name);
    text += fmt::format(" {}", format.extension);
    last = format.name;
  }
  return text + '\n';
}

std::string format_build(const BuildReport& report) {
  std::string text;
  const auto note = [&text](std::size_t count, std::string_view one, std::string_view many,
                            std::string_view what) {
    if (count == 0) return;
    text += fmt::format("note: {} {} {}\n", grouped(count), count == 1 ? one : many, what);
  };
  if (report.mirrored) {
    text += "note: the mesh was mirrored: two vertices were swapped in every tet to put it right\n";
  }
  note(report.reordered_tets, "tet", "tets", "listed the vertices the other way round: corrected");
  note(report.inverted_tets, "tet", "tets", "of negative volume");
  note(report.flat_tets, "tet", "tets", "of zero volume (or too close to tell)");
  note(report.constrained_faces, "face", "faces", "inside the volume constrained");
  note(report.dropped_triangles, "triangle", "triangles", "inside a region dropped");
  note(report.dropped_edges, "edge", "edges", "inside a region dropped");
  note(report.dropped_vertices, "vertex", "vertices", "inside a region no longer required");
  note(report.loose_triangles, "triangle", "triangles", "that no tet has as a face: kept as is");
  note(report.loose_edges, "edge", "edges", "that no tet has: kept as is");
  note(report.unused_points, "point", "points", "that no element uses: kept as is");
  return text;
}

nlohmann::json to_json(const BuildReport& report) {
  return {{"mirrored", report.mirrored},
          {"reordered_tets", report.reordered_tets},
          {"inverted_tets", report.inverted_tets},
          {"flat_tets", report.flat_tets},
          {"loose_triangles", report.loose_triangles},
          {"loose_edges", report.loose_edges},
          {"unused_points", report.unused_points},
          {"constrained_faces", report.constrained_faces},
          {"dropped_triangles", report.dropped_triangles},
          {"dropped_edges", report.dropped_edges},
          {"dropped_vertices", report.dropped_vertices}};
}

}  // namespace tetmend::apps
