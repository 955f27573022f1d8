// SPDX-License-Identifier: MIT
// All that tetmend knows of the operating system: files by descriptor, signals, the terminal, memory,
// shared libraries. No other folder includes a header of a system, which a test checks.
//
// platform_posix.cpp has the code for Linux and macOS, platform_windows.cpp that for Windows; the build
// takes both, and each is empty elsewhere. What the standard library has is not here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tetmend::platform {

/// What a call of the system gave, or why it gave nothing: a number of <cerrno>, whose text
/// std::generic_category() has.
template <class Value>
struct Answer {
  Value value{};
  int error = 0;
  explicit operator bool() const { return error == 0; }
};

// ---- files

/// An open file. Closes it when it goes.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, kNone)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  bool is_open() const { return number_ != kNone; }
  int number() const { return number_; }
  /// Does nothing when it is closed. The error number, or 0; it is closed in any case.
  int close() noexcept;

 private:
  static constexpr int kNone = -1;
  int number_ = kNone;
};

inline constexpr int kStandardInput = 0;
inline constexpr int kStandardOutput = 1;
inline constexpr int kStandardError = 2;

enum class FileKind : unsigned char { regular, folder, other };
struct FileFacts {
  FileKind kind = FileKind::other;
  std::uint64_t size = 0;
  std::uint64_t names = 1;  ///< hard links
  std::uint32_t owner = 0;  ///< this and the next two: 0 on Windows
  std::uint32_t group = 0;
  std::uint32_t permissions = 0;  ///< of owner, group and others, nine bits
};

/// Of the last name of a path.
enum class Links : unsigned char { followed, refused };
/// Never waits for the other side of a pipe. Of a folder: opens it, or EISDIR. Of a link that is
/// refused: ELOOP.
Answer<Descriptor> open_to_read(const std::filesystem::path& file, Links links = Links::followed);
/// A new file to be written. What is there already, even a link, is EEXIST.
enum class Access : unsigned char { as_usual, owner_only };
Answer<Descriptor> create(const std::filesystem::path& file, Access access);
/// Likewise, but what is there already is written on at its end. A link is ELOOP.
Answer<Descriptor> open_to_append(const std::filesystem::path& file);
/// A file without a name, to be written and then read by read_at(). It goes with its descriptor.
Answer<Descriptor> create_nameless();

Answer<FileFacts> look_at(int file);
/// Of what a link leads to.
Answer<FileFacts> look_at(const std::filesystem::path& file);
/// Of the link itself.
Answer<FileFacts> look_at_name(const std::filesystem::path& file);
/// Whether this user may write the file: the error number, or 0.
int may_write(const std::filesystem::path& file);

/// At least one byte, or none at the end; an interruption is none.
Answer<std::size_t> read_some(int file, std::span<char> buffer);
Answer<std::size_t> read_at(int file, std::uint64_t place, std::span<char> buffer);
/// Writes all of it, however often that is interrupted. The error number, or 0. A signal handler may
/// call it.
int write_fully(int file, std::string_view bytes) noexcept;
/// What was written is on the disk when it returns. The error number, or 0, also where the file system
/// cannot tell.
int synchronise(int file);
/// The same for the names in a folder; 0 also where this user may not read it.
int synchronise_folder(const std::filesystem::path& folder);

/// Who else may have the lock of a file.
enum class Sharing : unsigned char { none, others };
/// Opens a file to be read and written, made where there is none, and locks it: until the descriptor
/// goes, or its process, however that ends. Never waits: EWOULDBLOCK where another one has it, in this
/// process or in any other. ENOLCK, with the file open, where the file system knows no locks. A link
/// is ELOOP.
Answer<Descriptor> open_locked(const std::filesystem::path& file, Sharing sharing);

/// Which properties of an older file a new one could not be given.
struct OwnerLoss {
  bool group = false;
  bool owner = false;
  bool permissions = false;
};
/// Gives the new file the owner, group and permissions of the older one, as far as the system allows.
/// What a group may do that it cannot get is not for another group.
OwnerLoss keep_owner(int file, const FileFacts& now, const FileFacts& older);

/// Each: the error number, or 0. A rename replaces what has that name, at once for all who look.
int rename(const std::filesystem::path& from, const std::filesystem::path& to);
int add_name(const std::filesystem::path& file, const std::filesystem::path& name);
/// A signal handler may call it.
void remove_file(const std::filesystem::path::value_type* file) noexcept;

// ---- the program: streams, arguments, environment

/// Fills those of the descriptors 0 to 2 that are closed, so that no file that is opened later gets
/// what is said. Reading and writing fail there as before. From then on bytes go out as they are.
void reserve_standard_streams() noexcept;
bool is_terminal(int file) noexcept;
/// Columns of the terminal on standard error; 0: not known.
std::size_t terminal_columns() noexcept;

/// The command line in UTF-8 where paths are that, with the name of the program.
std::vector<std::string> arguments(int count, char** words);
/// The variable of the environment; empty where it is not set, or not this user's (setuid).
std::string trusted_variable(const char* name);
/// Between the folders of such a variable.
extern const char kPathSeparator;
/// The file of this program; empty if that cannot be told.
std::filesystem::path program_file();
unsigned process_number() noexcept;
/// Of this machine in its network; empty if that cannot be told.
std::string host_name();

// ---- signals. Handlers may call what says so, here and elsewhere.

using SignalHandler = void (*)(int number);

/// What terminals send; with `batch` also what batch systems send when the time of a job is nearly over.
enum class EndSignals : unsigned char { terminal, batch };
/// From now on they call the handler, but for those that the parent process chose to ignore (nohup).
void on_end_signals(EndSignals which, SignalHandler handler) noexcept;
/// Whether the system sends this signal again and again.
bool comes_again(int number) noexcept;
/// The signal acts as if it had no handler. For handlers, too; there it takes effect when they return.
void end_by_default(int number) noexcept;
/// A reader that goes away is from now on an error of the stream, a file beyond a limit one of writing.
void ignore_broken_pipes() noexcept;
void ignore_file_limits() noexcept;
/// From now on a crash calls the handler once, then acts as it would have.
void on_crashes(SignalHandler handler) noexcept;
/// Gives this thread room for the handler of a crash where an endless recursion has used up its stack.
void provide_crash_stack();

// ---- memory

/// The most bytes that this process had in memory; 0: not known.
std::size_t peak_memory() noexcept;
/// Gives the system back what was freed, where it would stay in pieces of the heap.
void trim_heap() noexcept;
/// From now on blocks of this size go back as soon as they are freed; the heap grows by as much.
void give_back_blocks_from(int bytes) noexcept;

// ---- shared libraries

/// A shared library in this process. Goes with the last of its owners, unless it was pinned.
class SharedLibrary {
 public:
  /// Opens it with everything bound, so that nothing is found missing later. Its initialisers run.
  explicit SharedLibrary(const std::filesystem::path& file);
  ~SharedLibrary();
  SharedLibrary(SharedLibrary&& other) noexcept
      : file_(std::move(other.file_)), handle_(std::exchange(other.handle_, nullptr)) {}
  SharedLibrary& operator=(SharedLibrary&&) = delete;

  bool is_open() const { return handle_ != nullptr; }
  /// Null if it has no such symbol.
  void* find(const char* symbol) const;
  /// It stays until the program ends.
  void pin() const;

 private:
  std::filesystem::path file_;
  void* handle_;
};

/// Why the last library could not be opened.
std::string loading_error();
/// Whether a library's file has a name like this one, by the extension.
bool is_library_name(const std::filesystem::path& file);
/// What a library's file says of a constant, before the library is loaded.
enum class ConstantSearch : unsigned char {
  found,
  absent,    ///< the library has none of that name with a value of that size
  cut_off,   ///< the file is shorter than its own head says: whoever loads it may crash
  no_answer  ///< no library for this machine, or none that can be understood here
};
/// Reads the value of a constant from a library's file. Precondition: the file is a regular one.
/// Cost: reads the heads, the table of dynamic symbols and the value.
ConstantSearch read_constant(const std::filesystem::path& file, std::string_view symbol,
                             std::span<std::byte> value);
/// Shows the names of the library that has this address to libraries that are loaded later.
void show_names_of_library(const void* address);

}  // namespace tetmend::platform
