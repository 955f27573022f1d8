// SPDX-License-Identifier: MIT
// Reading and writing of tetrahedral mesh files; the format follows from the extension.
#include "kernel/formats/mesh_io.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/cgns.h"
#include "kernel/formats/degenerate.h"
#include "kernel/formats/elmer.h"
#include "kernel/formats/exodus.h"
#include "kernel/formats/febio.h"
#include "kernel/formats/gmsh.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/inp.h"
#include "kernel/formats/lsdyna.h"
#include "kernel/formats/med.h"
#include "kernel/formats/medit_ascii.h"
#include "kernel/formats/medit_binary.h"
#include "kernel/formats/medit_elements.h"
#include "kernel/formats/mfem.h"
#include "kernel/formats/nastran.h"
#include "kernel/formats/nastran_numbers.h"
#include "kernel/formats/netgen.h"
#include "kernel/formats/new_numbers.h"
#include "kernel/formats/packed_file.h"
#include "kernel/formats/room.h"
#include "kernel/formats/standard_stream.h"
#include "kernel/formats/su2.h"
#include "kernel/formats/tet_place.h"
#include "kernel/formats/tetgen.h"
#include "kernel/formats/unv.h"
#include "kernel/formats/vtk_legacy.h"
#include "kernel/formats/vtk_roles.h"
#include "kernel/formats/vtu.h"
#include "kernel/formats/xdmf.h"
#include "kernel/nearest_word.h"
#include "kernel/second_order.h"

namespace tetmend {
namespace {

using formats::Room;

struct Codec {
  MeshData (*read)(const std::filesystem::path&, const formats::ReadRequest&);
  void (*write)(const std::filesystem::path&, const MeshView&);
  Room room;
  bool is_several_files = false;
  /// What else is lost, one sentence each; may be null.
  std::vector<std::string> (*lost)(const std::filesystem::path&, const MeshData&) = nullptr;
  /// Of the variant that is asked for; may be null.
  formats::FormNotes (*form)(const MeshData&, std::string_view variant) = nullptr;
};

/// For formats that have one place for labels.
template <MeshData (*Read)(const std::filesystem::path&, formats::TetPlace*)>
MeshData read_plain(const std::filesystem::path& file, const formats::ReadRequest& request) {
  if (!request.label_array.empty()) {
    throw Error(fmt::format("{}: the format has no arrays: none is named '{}'", file.string(),
                            request.label_array));
  }
  return Read(file, request.question);
}

constexpr std::array<MeshFormat, 24> kFormatsTable = {
    {{"MEDIT ASCII", ".mesh"}, {"MEDIT binary", ".meshb"},
     {"TetGen", ".node"},      {"TetGen", ".ele"},
     {"legacy VTK", ".vtk"},   {"VTK XML", ".vtu"},
     {"Gmsh", ".msh"},         {"Abaqus, CalculiX", ".inp"},
     {"SU2", ".su2"},          {"Netgen", ".vol"},
     {"Nastran", ".bdf"},      {"Nastran", ".nas"},
     {"Elmer", ".header"},     {"I-DEAS universal", ".unv"},
     {"MFEM", ".mfem"},        {"LS-DYNA", ".k"},
     {"LS-DYNA", ".key"},      {"FEBio", ".feb"},
     {"Exodus II", ".e"},      {"Exodus II", ".exo"},
     {"Exodus II", ".g"},      {"MED", ".med"},
     {"CGNS", ".cgns"},        {"XDMF", ".xdmf"}}};

constexpr std::size_t kOfHdf5 = 3;  // the last of them

constexpr Room kMeditRoom = {.others = true,
                             .required_vertices = true,
                             .second_order = true,
                             .marks = true,
                             .holds = formats::medit_holds};
constexpr Room kTetgenRoom = {
    .second_order = true, .both_orders = false, .own_arrays = formats::kTetgenArrays};
constexpr Room kVtkRoom = {.data = true, .others = true, .second_order = true};
constexpr Room kVtuRoom = {
    .data = true, .others = true, .second_order = true, .names_are_text = true};
constexpr Room kGmshRoom = {.data = true,
                            .groups = true,
                            .others = true,
                            .second_order = true,
                            .takes_name = formats::is_gmsh_name,
                            .names_are_unique = true};
constexpr Room kInpRoom = {.groups = true,
                           .others = true,
                           .required_vertices = true,
                           .second_order = true,
                           .second_order_edges = false,
                           .takes_name = formats::is_inp_name,
                           .deck = formats::kInp};
constexpr Room kSu2Room = {.others = true,
                           .second_order = true,
                           .point_labels = false,
                           .tet_labels = false,
                           .edges = false,
                           .holds = formats::su2_holds,
                           .named_labels = formats::kNamesOfTriangles,
                           .takes_name = formats::is_word,
                           .deck = formats::kSu2};
constexpr Room kNetgenRoom = {.others = true,
                              .second_order = true,
                              .point_labels = false,
                              .holds = formats::netgen_holds,
                              .named_labels = formats::kAllNames,
                              .takes_name = formats::is_word,
                              .periodic = true,
                              .own_arrays = "netgen:",
                              .deck = formats::kNetgen};
constexpr Room kNastranRoom = {.others = true,
                               .second_order = true,
                               .point_labels = false,
                               .edges = false,
                               .holds = formats::nastran_holds,
                               .low_labels = false,
                               .absent_labels = false,
                               .deck = formats::kNastran};
constexpr Room kElmerRoom = {.others = true,
                             .second_order = true,
                             .point_labels = false,
                             .holds = formats::elmer_holds,
                             .named_labels = formats::kNamesOfElements,
                             .takes_name = formats::is_word};

constexpr Room kMedRoom = {.data = true,
                           .groups = true,
                           .geometry = false,
                           .others = true,
                           .second_order = true,
                           .holds = formats::med_holds,
                           .takes_name = formats::is_med_name,
                           .group_names_are_unique = true,
                           .deck = formats::kMed};

constexpr Room kUnvRoom = {.groups = true,
                           .geometry = false,
                           .others = true,
                           .second_order = true,
                           .point_labels = false,
                           .holds = formats::unv_holds,
                           .takes_name = formats::is_unv_name,
                           .own_arrays = "unv:",
                           .deck = formats::kUnv};

constexpr Room kMfemRoom = {.groups = true,
                            .geometry = false,
                            .others = true,
                            .second_order = true,
                            .point_labels = false,
                            .edges = false,
                            .holds = formats::mfem_holds,
                            .takes_name = formats::is_mfem_name,
                            .low_labels = false,
                            .absent_labels = false};

constexpr Room kLsDynaRoom = {.groups = true,
                              .geometry = false,
                              .others = true,
                              .second_order = true,
                              .point_labels = false,
                              .edges = false,
                              .holds = formats::lsdyna_holds,
                              .takes_name = formats::is_lsdyna_name,
                              .low_labels = false,
                              .absent_labels = false,
                              .deck = formats::kLsDyna};
constexpr Room kFebioRoom = {.groups = true,
                             .geometry = false,
                             .others = true,
                             .second_order = true,
                             .point_labels = false,
                             .edges = false,
                             .holds = formats::febio_holds,
                             .group_names_are_unique = true,
                             .deck = formats::kFebio};

constexpr Room kExodusRoom = {.data = true,
                              .data_of = formats::kDataOfAllButFaces,
                              .groups = true,
                              .geometry = false,
                              .others = true,
                              .second_order = true,
                              .point_labels = false,
                              .holds = formats::exodus_holds,
                              .takes_name = formats::is_exodus_name,
                              .low_labels = false,
                              .absent_labels = false,
                              .deck = formats::kExodus};

constexpr Room kCgnsRoom = {.data = true,
                            .data_of = formats::kDataOfVolumes,
                            .groups = true,
                            .geometry = false,
                            .others = true,
                            .second_order = true,
                            .point_labels = false,
                            .holds = formats::cgns_holds,
                            .takes_name = formats::is_cgns_name,
                            .names_are_unique = true,
                            .group_names_are_unique = true,
                            .low_labels = false,
                            .deck = formats::kCgns};

constexpr Room kXdmfRoom = {.data = true,
                            .data_of = formats::kDataOfVolumes,
                            .others = true,
                            .second_order = true,
                            .point_labels = false,
                            .holds = formats::xdmf_holds,
                            .names_are_text = true,
                            .deck = formats::kXdmf};

// In the order of formats_table.
constexpr std::array<Codec, 24> kCodecs = {
    {{read_plain<formats::read_medit_ascii>, formats::write_medit_ascii, kMeditRoom},
     {read_plain<formats::read_medit_binary>, formats::write_medit_binary, kMeditRoom},
     {read_plain<formats::read_tetgen>, formats::write_tetgen, kTetgenRoom, true},
     {read_plain<formats::read_tetgen>, formats::write_tetgen, kTetgenRoom, true},
     {formats::read_vtk_legacy, formats::write_vtk_legacy, kVtkRoom},
     {formats::read_vtu, formats::write_vtu, kVtuRoom},
     {read_plain<formats::read_gmsh>, formats::write_gmsh, kGmshRoom},
     {read_plain<formats::read_inp>, formats::write_inp, kInpRoom, false, formats::not_in_inp},
     {read_plain<formats::read_su2>, formats::write_su2, kSu2Room},
     {read_plain<formats::read_netgen>, formats::write_netgen, kNetgenRoom},
     {read_plain<formats::read_nastran>, formats::write_nastran, kNastranRoom, false,
      formats::not_in_nastran, formats::nastran_form},
     {read_plain<formats::read_nastran>, formats::write_nastran, kNastranRoom, false,
      formats::not_in_nastran, formats::nastran_form},
     {read_plain<formats::read_elmer>, formats::write_elmer, kElmerRoom, true},
     {read_plain<formats::read_unv>, formats::write_unv, kUnvRoom, false, formats::not_in_unv},
     {read_plain<formats::read_mfem>, formats::write_mfem, kMfemRoom, false, formats::not_in_mfem},
     {read_plain<formats::read_lsdyna>, formats::write_lsdyna, kLsDynaRoom, false,
      formats::not_in_lsdyna},
     {read_plain<formats::read_lsdyna>, formats::write_lsdyna, kLsDynaRoom, false,
      formats::not_in_lsdyna},
     {read_plain<formats::read_febio>, formats::write_febio, kFebioRoom},
     {read_plain<formats::read_exodus>, formats::write_exodus, kExodusRoom, false,
      formats::not_in_exodus},
     {read_plain<formats::read_exodus>, formats::write_exodus, kExodusRoom, false,
      formats::not_in_exodus},
     {read_plain<formats::read_exodus>, formats::write_exodus, kExodusRoom, false,
      formats::not_in_exodus},
     {read_plain<formats::read_med>, formats::write_med, kMedRoom, false, formats::not_in_med},
     {read_plain<formats::read_cgns>, formats::write_cgns, kCgnsRoom, false, formats::not_in_cgns},
     {formats::read_xdmf, formats::write_xdmf, kXdmfRoom, true, formats::not_in_xdmf}}};

static_assert(kFormatsTable.size() == kCodecs.size() && kCodecs.back().read != nullptr);

/// Of "part.VTU.gz" that is ".vtu".
std::string format_extension(const std::filesystem::path& file) {
  const bool is_packed = formats::has_packed_name(file);
  std::string extension = (is_packed ? file.stem() : file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Of first or second order.
bool has_tets(const MeshData& mesh) {
  return !mesh.tets.empty() ||
         std::any_of(mesh.other_elements.begin(), mesh.other_elements.end(),
                     [](const OtherElements& others) {
                       return others.vtk_type == formats::vtk_tet10 && !others.labels.empty();
                     });
}

/// Nobody packs several files one by one.
const Codec& find_codec(const std::filesystem::path& file) {
  const bool is_packed = formats::has_packed_name(file);
  const std::string extension = format_extension(file);
  std::string valid;
  for (std::size_t i = 0; i < kFormatsTable.size(); ++i) {
    const bool is_single = !kCodecs[i].is_several_files;
    if (kFormatsTable[i].extension == extension && (is_single || !is_packed)) {
      if (is_single || !formats::is_standard_stream(file)) return kCodecs[i];
      throw Error(fmt::format("{}: a mesh of this format is several files: expected a file",
                              file.string()));
    }
    valid += valid.empty() ? "" : ", ";
    valid += kFormatsTable[i].extension;
  }
  throw Error(fmt::format(
      "{}: the extension '{}' is not that of a mesh format: expected one of {}{}", file.string(),
      file.extension().string(), valid, guess_of(file.extension().string(), valid)));
}

/// A mesh of MFEM stays one under the name .mesh, too.
const Codec& codec_to_write(const std::filesystem::path& file, std::string_view variant) {
  const bool is_mfems = variant == formats::kMfem && format_extension(file) == ".mesh";
  return find_codec(is_mfems ? std::filesystem::path("a.mfem") : file);
}

}  // namespace

std::span<const MeshFormat> mesh_formats() {
  return std::span(kFormatsTable).first(kFormatsTable.size() - (formats::has_hdf5() ? 0 : kOfHdf5));
}

MeshData read_mesh(const std::filesystem::path& file, const std::string& label_array) {
  try {
    MeshData mesh = find_codec(file).read(file, {nullptr, label_array});
    formats::note_taken_numbers(mesh);
    const auto dropped = formats::drop_degenerate(mesh, [&](int dimension, std::size_t number) {
      formats::TetPlace question{number, {}, dimension};
      if (formats::is_standard_stream(file)) return question.place;  // it is read once
      find_codec(file).read(file, {&question, label_array});
      return question.place;
    });
    if (!dropped.empty() && !has_tets(mesh)) {
      throw Error(
          fmt::format("{}: no tet is left: each of them has a vertex twice", file.string()));
    }
    try {
      take_second_order(mesh);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", file.string(), error.what()));
    }
    return mesh;
  } catch (const std::bad_alloc&) {
    throw Error(fmt::format("{}: cannot be read: not enough memory", file.string()));
  }
}

std::string locate_tet(const std::filesystem::path& file, std::size_t tet) {
  formats::TetPlace question{tet, file.string()};
  MeshData mesh = find_codec(file).read(file, {&question, {}});
  std::size_t number = tet;  // in the file, where those that were dropped count
  for (const std::uint32_t dropped : formats::drop_degenerate(mesh)) number += dropped <= number;
  if (number == tet) return question.place;
  question = {number, file.string()};
  find_codec(file).read(file, {&question, {}});
  return question.place;
}

std::vector<std::string> not_written(const std::filesystem::path& file, const MeshData& mesh,
                                     std::string_view variant) {
  const Codec& codec = codec_to_write(file, mesh.variant);
  std::vector<std::string> notes = formats::lost_in(codec.room, format_extension(file), mesh);
  if (codec.lost != nullptr) {
    for (std::string& note : codec.lost(file, mesh)) notes.push_back(std::move(note));
  }
  if (codec.form != nullptr && !variant.empty()) {
    for (std::string& note : codec.form(mesh, variant).lost) notes.push_back(std::move(note));
  }
  return notes;
}

std::vector<std::string> remarks_on_writing(const std::filesystem::path& file, const MeshData& mesh,
                                            std::string_view variant) {
  const Codec& codec = codec_to_write(file, mesh.variant);
  return codec.form == nullptr ? std::vector<std::string>() : codec.form(mesh, variant).remarks;
}

std::span<const std::string_view> mesh_variants(const std::filesystem::path& file) {
  static constexpr std::array<std::string_view, 4> kOfGmsh = {"2.2 ASCII", "2.2 binary",
                                                              "4.1 ASCII", "4.1 binary"};
  static constexpr std::array kOfVtk = {formats::kVtkAscii, formats::kVtkBinary};
  static constexpr std::array kOfTetgen = {formats::kTetgenFromZero, formats::kTetgenFromOne};
  static constexpr std::array kOfInp = {formats::kInpLists, formats::kInpRanges};
  const std::string extension = format_extension(file);
  if (extension == ".msh") return kOfGmsh;
  if (extension == ".vtk" || extension == ".vtu") return kOfVtk;
  if (extension == ".node" || extension == ".ele") return kOfTetgen;
  if (extension == ".inp") return kOfInp;
  if (extension == ".bdf" || extension == ".nas") return formats::kNastranForms;
  return {};
}

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& file) {
  const std::string extension = formats::has_packed_name(file) ? "" : format_extension(file);
  if (extension == ".node" || extension == ".ele") return formats::tetgen_files(file);
  if (extension == ".header") return formats::elmer_files(file);
  if (extension == ".xdmf") return formats::xdmf_files(file);
  return {file};
}

std::vector<std::filesystem::path> source_files(const std::filesystem::path& file) {
  const std::string extension = format_extension(file);
  if (extension == ".inp") return formats::inp_files(file);
  if (extension == ".bdf" || extension == ".nas") return formats::nastran_files(file);
  if (extension == ".k" || extension == ".key") return formats::lsdyna_files(file);
  return mesh_files(file);
}

std::string format_name(const std::filesystem::path& file) {
  const std::string extension = format_extension(file);
  const auto* const found =
      std::find_if(kFormatsTable.begin(), kFormatsTable.end(),
                   [&](const MeshFormat& format) { return format.extension == extension; });
  if (found == kFormatsTable.end()) return {};
  return std::string(found->name) +
         (formats::has_packed_name(file) ? file.extension().string() : "");
}

void write_mesh(const std::filesystem::path& file, const MeshData& mesh) {
  assert(mesh.point_labels.empty() || mesh.point_labels.size() == mesh.points.size());
  write_mesh(file, MeshView(mesh));
}

void write_mesh(const std::filesystem::path& file, const MeshView& mesh) {
  formats::check_packing_to_write(file);
  const Codec& codec = codec_to_write(file, mesh.variant());
  if (mesh.data() == nullptr || mesh.data()->mid_nodes.empty()) return codec.write(file, mesh);
  const formats::Room& room = codec.room;
  const bool has_marks = room.groups || room.marks || room.named_labels != 0;
  const bool has_edges = room.second_order_edges || room.deck == mesh.data()->variant;
  const MeshData as_held = room.second_order ? with_second_order(*mesh.data(), has_marks, has_edges)
                                             : without_mid_nodes(*mesh.data());
  MeshView view(as_held);
  view.set_variant(mesh.variant());
  view.set_companions(mesh.companions());
  codec.write(file, view);
}

}  // namespace tetmend
