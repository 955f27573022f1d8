// SPDX-License-Identifier: MIT
// A damaged folder of a run in pieces. The input changes one file of the checkpoint of a run that was
// killed: the same command has the bytes of a run that was never killed then, or an Error of one line
// that names the folder. Or it changes the file and seals it anew: an Error of one line, or pieces.
//
//   which file | 1: seal it, 2: cut it | where it is cut, two bytes | changes: place, two bytes; value
#include <algorithm>
#include <vector>

#include "contract/zoo.h"
#include "fuzz/target.h"
#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "pieces/folder_run.h"

using namespace tetmend;
using namespace tetmend::fuzz;

namespace {

/// A mesh, a checkpoint of a run on it, and what the run makes of it.
class Killed {
 public:
  Killed() {
    write_mesh(folder_ / "in.meshb", contract::kuhn_cube(4, 0.3, 1));
    improve({});
    expected = read_file(out_);
    int calls = 0;
    try {
      improve([&](std::size_t, pieces::Piece&) {
        if (++calls > 2 * 2 + 1) throw Error("killed");
      });
    } catch (const Error&) {
      std::filesystem::copy(checkpoint, good_, std::filesystem::copy_options::recursive);
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(good_)) {
      if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(good_));
    }
    std::sort(files.begin(), files.end());
    require(files.size() > 4, "there is a checkpoint");
  }

  void restore() const {
    std::filesystem::remove_all(checkpoint);
    std::filesystem::remove(out_);
    std::filesystem::copy(good_, checkpoint, std::filesystem::copy_options::recursive);
  }
  void improve(const std::function<void(std::size_t, pieces::Piece&)>& fault) const {
    pieces::OutOfCore all{.input = folder_ / "in.meshb", .output = out_, .scratch = {}};
    all.checkpoint = checkpoint;
    all.fault = fault;
    pieces::Division division;
    division.pieces = 2;
    pieces::OneRank alone;
    Options options;
    options.script = "smooth{}";
    options.surface = "5%";
    pieces::improve_files(all, options, division, alone);
  }
  std::string made() const { return read_file(out_); }

  std::filesystem::path checkpoint = folder_ / "ck";
  std::string expected;
  std::vector<std::filesystem::path> files;  // of the checkpoint

 private:
  static inline const RamFolder folder_;
  std::filesystem::path good_ = folder_ / "good";
  std::filesystem::path out_ = folder_ / "out.meshb";
};

void change(std::string& content, Bytes& input, bool is_cut) {
  const std::size_t end = input.take<std::uint16_t>();
  if (is_cut) content.resize(std::min(content.size(), end));
  while (!input.empty() && !content.empty()) {
    const std::size_t place = input.take<std::uint16_t>() % content.size();
    content[place] = static_cast<char>(input.take<std::uint8_t>());
  }
}

/// All that a run reads of its pieces.
void read_all(const std::filesystem::path& checkpoint) {
  const pieces::RunFolder folder(checkpoint);
  const pieces::SavedRun saved = folder.load();
  std::string_view surface;
  const std::string bytes = folder.load_surface(saved);
  for (surface = bytes; !surface.empty();) pieces::take_share(surface);
  pieces::SealedShelf shelf = folder.pieces_of(saved);
  pieces::OneRank alone;
  const pieces::DividedMesh mesh(shelf, alone, saved.mesh);
  for (const std::size_t part : mesh.own()) {
    mesh.all_of(part);
    mesh.stored_ids(part);
    mesh.stored_vertices(part, 1, 3);
  }
}

/// Changes what a file says, and seals it.
void forge(const Killed& killed, const std::filesystem::path& file, Bytes& input, bool is_cut) {
  const pieces::SavedRun saved = pieces::RunFolder(killed.checkpoint).load();
  const bool is_piece = file.has_parent_path();
  const bool is_state = file == "run";
  if (file == "lock") return;
  pieces::SealedShelf shelf =
      is_piece   ? pieces::RunFolder(killed.checkpoint).pieces_of(saved)
      : is_state ? pieces::SealedShelf(killed.checkpoint, "", 0)
                 : pieces::SealedShelf(killed.checkpoint, "", pieces::number_of(saved));
  const std::string name = file.filename().string();
  std::string content = shelf.read(name);
  change(content, input, is_cut);
  shelf.put(name, std::move(content));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Killed killed;
  Bytes input(data, size);
  killed.restore();
  const auto& file = killed.files[input.below(static_cast<unsigned>(killed.files.size()))];
  const unsigned how = input.below(4);
  const bool is_cut = (how & 2U) != 0;
  try {
    if ((how & 1U) != 0) {
      forge(killed, file, input, is_cut);
      read_all(killed.checkpoint);
      return 0;
    }
    std::string content = read_file(killed.checkpoint / file);
    change(content, input, is_cut);
    write_file(killed.checkpoint / file, content);
    killed.improve({});
    require(killed.made() == killed.expected, "the same bytes as without a crash");
  } catch (const Error& error) {
    require_one_line(error.what());
    const std::string message = error.what();
    require(message.find(killed.checkpoint.string()) != message.npos,
            "it names the folder: " + message);
  }
  return 0;
}
