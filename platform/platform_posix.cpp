// SPDX-License-Identifier: MIT
// Linux and macOS.
#ifndef _WIN32
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <memory>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "platform/child.h"
#include "platform/memory.h"
#include "platform/platform.h"
#ifdef __linux__
#include <link.h>
#include <sys/mman.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __APPLE__
#include <crt_externs.h>
#include <mach-o/dyld.h>
#endif

namespace tetmend::platform {
namespace {

constexpr mode_t kPermissions = 0777;  // not setuid and its like: the content is another

/// A number of open(), memfd_create() and their like, or errno.
Answer<Descriptor> opened(int number) {
  if (number < 0) return {Descriptor(), errno};
  return {Descriptor(number), 0};
}

Answer<FileFacts> facts_of(int result, const struct stat& info) {
  if (result != 0) return {{}, errno};
  FileFacts facts;
  if (S_ISREG(info.st_mode)) facts.kind = FileKind::regular;
  if (S_ISDIR(info.st_mode)) facts.kind = FileKind::folder;
  facts.size = static_cast<std::uint64_t>(info.st_size);
  facts.names = info.st_nlink;
  facts.owner = info.st_uid;
  facts.group = info.st_gid;
  facts.permissions = info.st_mode & kPermissions;
  return {facts, 0};
}

}  // namespace

// ---- files

int Descriptor::close() noexcept {
  if (!is_open()) return 0;
  return ::close(std::exchange(number_, kNone)) == 0 ? 0 : errno;
}

Answer<Descriptor> open_to_read(const std::filesystem::path& file, Links links) {
  const int follow = links == Links::refused ? O_NOFOLLOW : 0;
  return opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | follow));
}

Answer<Descriptor> create(const std::filesystem::path& file, Access access) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  return opened(::open(file.c_str(), kFlags, access == Access::owner_only ? 0600 : 0666));
}

Answer<Descriptor> open_to_append(const std::filesystem::path& file) {
  constexpr int kFlags = O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  return opened(::open(file.c_str(), kFlags, 0666));
}

Answer<Descriptor> create_nameless() {
#ifdef __linux__
  return opened(::memfd_create("tetmend", MFD_CLOEXEC));
#else
  std::error_code ignored;
  std::string name = std::filesystem::temp_directory_path(ignored) / "tetmend-XXXXXX";
  const int number = ::mkstemp(name.data());
  if (number < 0) return {Descriptor(), errno};
  ::unlink(name.c_str());
  ::fcntl(number, F_SETFD, FD_CLOEXEC);
  return {Descriptor(number), 0};
#endif
}

Answer<FileFacts> look_at(int file) {
  struct stat info {};
  return facts_of(::fstat(file, &info), info);
}

Answer<FileFacts> look_at(const std::filesystem::path& file) {
  struct stat info {};
  return facts_of(::stat(file.c_str(), &info), info);
}

Answer<FileFacts> look_at_name(const std::filesystem::path& file) {
  struct stat info {};
  return facts_of(::lstat(file.c_str(), &info), info);
}

int may_write(const std::filesystem::path& file) {
  return ::access(file.c_str(), W_OK) == 0 ? 0 : errno;
}

Answer<std::size_t> read_some(int file, std::span<char> buffer) {
  for (;;) {
    const ssize_t got = ::read(file, buffer.data(), buffer.size());
    if (got >= 0) return {static_cast<std::size_t>(got), 0};
    if (errno != EINTR) return {0, errno};
  }
}

Answer<std::size_t> read_at(int file, std::uint64_t place, std::span<char> buffer) {
  for (;;) {
    const ssize_t got = ::pread(file, buffer.data(), buffer.size(), static_cast<off_t>(place));
    if (got >= 0) return {static_cast<std::size_t>(got), 0};
    if (errno != EINTR) return {0, errno};
  }
}

int write_fully(int file, std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int synchronise(int file) {
#ifdef __APPLE__
  if (::fcntl(file, F_FULLFSYNC) == 0) return 0;  // fsync() leaves it in the cache of the disk
#endif
  while (::fsync(file) != 0) {
    if (errno == EINTR) continue;
    // Some file systems know no fsync: then there is nothing to wait for.
    const bool is_unknown =
        errno == EINVAL || errno == ENOTSUP || errno == ENOSYS || errno == EROFS;
    return is_unknown ? 0 : errno;
  }
  return 0;
}

int synchronise_folder(const std::filesystem::path& folder) {
  const auto open = opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!open) return open.error == EACCES ? 0 : open.error;
  return synchronise(open.value.number());
}

Answer<Descriptor> open_locked(const std::filesystem::path& file, Sharing sharing) {
  constexpr int kFlags = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  for (;;) {
    auto open = opened(::open(file.c_str(), kFlags, 0666));
    if (!open) return open;
    const int kind = sharing == Sharing::none ? LOCK_EX : LOCK_SH;
    int result = 0;
    do {
      result = ::flock(open.value.number(), kind | LOCK_NB);
    } while (result != 0 && errno == EINTR);
    if (result != 0) {
      open.error = errno == EWOULDBLOCK ? EWOULDBLOCK : ENOLCK;
      return open;
    }
    const auto facts = look_at(open.value.number());
    if (!facts || facts.value.names > 0) return open;
    // Who had it before has removed the file meanwhile: this lock keeps nobody away.
  }
}

OwnerLoss keep_owner(int file, const FileFacts& now, const FileFacts& older) {
  OwnerLoss loss;
  auto mode = static_cast<mode_t>(older.permissions);
  if (now.group != older.group && ::fchown(file, static_cast<uid_t>(-1), older.group) != 0) {
    mode = static_cast<mode_t>((mode & ~070u) | ((mode & 007u) << 3));
    loss.group = true;
  }
  loss.owner = now.owner != older.owner && ::fchown(file, older.owner, static_cast<gid_t>(-1)) != 0;
  loss.permissions = ::fchmod(file, mode) != 0 && now.permissions != mode;
  return loss;
}

int rename(const std::filesystem::path& from, const std::filesystem::path& to) {
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

int add_name(const std::filesystem::path& file, const std::filesystem::path& name) {
  return ::link(file.c_str(), name.c_str()) == 0 ? 0 : errno;
}

void remove_file(const char* file) noexcept {
  ::unlink(file);
}

// ---- the program: streams, arguments, environment

void reserve_standard_streams() noexcept {
  // The other way round: what is meant for reading can only be written, and vice versa.
  constexpr std::array<int, 3> kModes = {O_WRONLY, O_RDONLY, O_RDONLY};
  for (int number = kStandardInput; number <= kStandardError; ++number) {
    if (::fcntl(number, F_GETFD) != -1) continue;
    // The lowest free number is this one, for those below are taken.
    static_cast<void>(::open("/dev/null", kModes[static_cast<std::size_t>(number)]));
  }
}

bool is_terminal(int file) noexcept {
  return ::isatty(file) == 1;
}

std::size_t terminal_columns() noexcept {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

std::vector<std::string> arguments(int count, char** words) {
  return {words, words + count};
}

std::string trusted_variable(const char* name) {
#ifdef __linux__
  const char* value = ::secure_getenv(name);
#else
  const char* value = ::issetugid() != 0 ? nullptr : ::getenv(name);
#endif
  return value == nullptr ? "" : value;
}

const char kPathSeparator = ':';

std::filesystem::path program_file() {
  std::error_code ignored;
#ifdef __APPLE__
  std::uint32_t size = 0;
  ::_NSGetExecutablePath(nullptr, &size);
  std::string name(size, '\0');
  if (::_NSGetExecutablePath(name.data(), &size) != 0) return {};
  return std::filesystem::canonical(name.c_str(), ignored);
#else
  return std::filesystem::read_symlink("/proc/self/exe", ignored);
#endif
}

unsigned process_number() noexcept {
  return static_cast<unsigned>(::getpid());
}

std::string host_name() {
  constexpr std::size_t kLongest = 256;
  std::array<char, kLongest> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// ---- signals

namespace {

void handle(int number, SignalHandler handler, int flags) noexcept {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  ::sigaction(number, &action, nullptr);
}

// A signal handler can reach nothing but globals.
std::atomic<SignalHandler> crash_handler{nullptr};
static_assert(std::atomic<SignalHandler>::is_always_lock_free);

void on_crash(int number) {
  crash_handler.load()(number);
  ::raise(number);  // SA_RESETHAND: acts as it would have, when the handler returns
}

class AlternateStack {
 public:
  AlternateStack() : memory_(std::make_unique<char[]>(kSize)) {
    stack_t stack{};
    stack.ss_sp = memory_.get();
    stack.ss_size = kSize;
    ::sigaltstack(&stack, &before_);
  }
  ~AlternateStack() { ::sigaltstack(&before_, nullptr); }
  AlternateStack(const AlternateStack&) = delete;
  AlternateStack& operator=(const AlternateStack&) = delete;

 private:
  static constexpr std::size_t kSize = 1 << 16;
  std::unique_ptr<char[]> memory_;
  stack_t before_{};
};

}  // namespace

void on_end_signals(EndSignals which, SignalHandler handler) noexcept {
  for (const int number : {SIGHUP, SIGINT, SIGTERM, SIGXCPU, SIGUSR1, SIGUSR2, SIGALRM}) {
    if (number == SIGXCPU && which == EndSignals::terminal) break;
    struct sigaction action {};
    ::sigaction(number, nullptr, &action);
    if (action.sa_handler != SIG_IGN) handle(number, handler, SA_RESTART);
  }
}

bool comes_again(int number) noexcept {
  return number == SIGXCPU;  // every second
}

void end_by_default(int number) noexcept {
  ::signal(number, SIG_DFL);
  ::raise(number);
}

void ignore_broken_pipes() noexcept {
  ::signal(SIGPIPE, SIG_IGN);
}

void ignore_file_limits() noexcept {
  ::signal(SIGXFSZ, SIG_IGN);
}

void on_crashes(SignalHandler handler) noexcept {
  crash_handler = handler;
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    handle(number, on_crash, static_cast<int>(SA_ONSTACK | SA_RESETHAND));
  }
}

void provide_crash_stack() {
  thread_local const AlternateStack kStack;
}

// ---- other programs

namespace {

char** environment() {
#ifdef __APPLE__
  return *::_NSGetEnviron();
#else
  return environ;
#endif
}

int spawn(const std::vector<std::string>& arguments, int input, int complaints, pid_t& process) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  if (::posix_spawn_file_actions_init(&files) != 0) return ENOMEM;
  if (::posix_spawnattr_init(&attributes) != 0) {
    ::posix_spawn_file_actions_destroy(&files);
    return ENOMEM;
  }
  ::posix_spawn_file_actions_adddup2(&files, input, kStandardInput);
  ::posix_spawn_file_actions_addopen(&files, kStandardOutput, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, complaints, kStandardError);
  sigset_t usual;
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  ::posix_spawnattr_setsigdefault(&attributes, &usual);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  std::vector<char*> words;
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const int error =
      ::posix_spawnp(&process, words[0], &files, &attributes, words.data(), environment());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  return error;
}

}  // namespace

Child::Child(const std::vector<std::string>& arguments) {
  Answer<Descriptor> complaints = create_nameless();
  std::array<int, 2> ends{};
  error_ = complaints.error;
  if (error_ == 0 && ::pipe(ends.data()) != 0) error_ = errno;
  if (error_ != 0) return;
  complaints_ = std::move(complaints.value);
  const Descriptor output(ends[0]);
  input_ = Descriptor(ends[1]);
  for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  ignore_broken_pipes();
  pid_t process = 0;
  error_ = spawn(arguments, output.number(), complaints_.number(), process);
  if (error_ == 0) process_ = process;
}

int Child::wait() noexcept {
  input_.close();
  if (process_ == 0) return status_;
  int status = 0;
  while (::waitpid(static_cast<pid_t>(process_), &status, 0) < 0) {
    if (errno != EINTR) {
      status = 1 << 8;  // as of a program that failed
      break;
    }
  }
  process_ = 0;
  constexpr int kBySignal = 128;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : kBySignal + WTERMSIG(status);
  return status_;
}

// ---- memory

std::size_t peak_memory() noexcept {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  constexpr std::size_t kUnit = 1;
#else
  constexpr std::size_t kUnit = 1024;
#endif
  return static_cast<std::size_t>(usage.ru_maxrss) * kUnit;
}

std::uint64_t memory_for_process() noexcept {
  std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
  const auto at_most = [&bytes](std::uint64_t limit) { bytes = std::min(bytes, limit); };
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long size = ::sysconf(_SC_PAGESIZE);
  if (pages > 0 && size > 0) {
    at_most(static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size));
  }
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    at_most(limit.rlim_cur);
  }
  try {  // a container of Linux; where there is none the file says "max", or is not there
    std::ifstream file("/sys/fs/cgroup/memory.max");
    std::uint64_t most = 0;
    if (file >> most) at_most(most);
  } catch (...) {
    return bytes;
  }
  return bytes;
}

void trim_heap() noexcept {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

void give_back_blocks_from([[maybe_unused]] int bytes) noexcept {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, bytes);
  ::mallopt(M_TOP_PAD, bytes);
#endif
}

// ---- shared libraries

SharedLibrary::SharedLibrary(const std::filesystem::path& file)
    : file_(file), handle_(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {}

SharedLibrary::~SharedLibrary() {
  if (handle_ != nullptr) ::dlclose(handle_);
}

void* SharedLibrary::find(const char* symbol) const {
  return ::dlsym(handle_, symbol);
}

void SharedLibrary::pin() const {
  void* again = ::dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (again != nullptr) ::dlclose(again);
}

std::string loading_error() {
  const char* text = ::dlerror();
  return text == nullptr ? "unknown reason" : text;
}

bool is_library_name(const std::filesystem::path& file) {
#ifdef __APPLE__
  if (file.extension() == ".dylib") return true;
#endif
  return file.extension() == ".so";
}

void show_names_of_library(const void* address) {
  Dl_info library{};
  if (::dladdr(address, &library) == 0) return;
  ::dlopen(library.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_GLOBAL);  // stays: never closed
}

#ifdef __linux__
namespace {

using Head = ElfW(Ehdr);
using Segment = ElfW(Phdr);
using Fact = ElfW(Dyn);
using Symbol = ElfW(Sym);

constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // of a table; a larger one is none

/// Whether the file is for a program like this one.
bool is_library_of_this_machine(const Head& head) {
  constexpr unsigned char kClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  constexpr unsigned char kOrder =
      std::endian::native == std::endian::little ? ELFDATA2LSB : ELFDATA2MSB;
  const auto* ident = reinterpret_cast<const char*>(head.e_ident);
  return std::string_view(ident, SELFMAG) == ELFMAG && head.e_ident[EI_CLASS] == kClass &&
         head.e_ident[EI_DATA] == kOrder && head.e_type == ET_DYN &&
         head.e_phentsize == sizeof(Segment);
}

/// As the dynamic linker sees it:
///   head -> segments -> facts of the dynamic segment -> symbols and their names -> the value
class ElfFile {
 public:
  explicit ElfFile(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(file, error);
    if (error) size_ = 0;
  }

  ConstantSearch read_constant(std::string_view name, std::span<std::byte> value) {
    const std::vector<Head> head = read<Head>(0, 1);
    if (head.empty() || !is_library_of_this_machine(head[0])) return ConstantSearch::no_answer;
    segments_ = read<Segment>(head[0].e_phoff, head[0].e_phnum);
    if (segments_.size() != head[0].e_phnum || !has_sections(head[0])) {
      return ConstantSearch::cut_off;
    }
    for (const Segment& segment : segments_) {
      const bool is_there =
          segment.p_type != PT_LOAD ||
          (segment.p_offset <= size_ && segment.p_filesz <= size_ - segment.p_offset);
      if (!is_there) return ConstantSearch::cut_off;
    }
    for (const Segment& segment : segments_) {
      if (segment.p_type != PT_DYNAMIC) continue;
      read_facts(segment);
      if (read_among(name, value)) return ConstantSearch::found;
    }
    return ConstantSearch::absent;
  }

 private:
  /// Their table is the end of most files: a copy that was cut lacks it first.
  bool has_sections(const Head& head) const {
    const std::uint64_t size = std::uint64_t{head.e_shnum} * head.e_shentsize;
    return head.e_shoff <= size_ && size <= size_ - head.e_shoff;
  }
  /// Empty when the file has not so much.
  template <class Row>
  std::vector<Row> read(std::uint64_t at, std::uint64_t count) {
    std::vector<Row> rows;
    if (count > kMostBytes / sizeof(Row) || at > size_ || count * sizeof(Row) > size_ - at)
      return {};
    rows.resize(count);
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at));
    in_.read(reinterpret_cast<char*>(rows.data()),
             static_cast<std::streamsize>(count * sizeof(Row)));
    if (!in_) rows.clear();
    return rows;
  }
  /// Of what is at an address when the library is loaded.
  template <class Row>
  std::vector<Row> read_at_address(std::uint64_t address, std::uint64_t count) {
    for (const Segment& segment : segments_) {
      if (segment.p_type != PT_LOAD || address < segment.p_vaddr) continue;
      const std::uint64_t inside = address - segment.p_vaddr;
      if (inside > segment.p_filesz || count > (segment.p_filesz - inside) / sizeof(Row)) continue;
      return read<Row>(segment.p_offset + inside, count);
    }
    return {};
  }

  void read_facts(const Segment& segment) {
    facts_ = {};
    for (const Fact& fact : read<Fact>(segment.p_offset, segment.p_filesz / sizeof(Fact))) {
      if (fact.d_tag == DT_NULL) break;
      if (fact.d_tag == DT_SYMTAB) facts_.symbols = fact.d_un.d_ptr;
      if (fact.d_tag == DT_STRTAB) facts_.names = fact.d_un.d_ptr;
      if (fact.d_tag == DT_STRSZ) facts_.size_of_names = fact.d_un.d_val;
      if (fact.d_tag == DT_HASH) facts_.hash = fact.d_un.d_ptr;
      if (fact.d_tag == DT_GNU_HASH) facts_.gnu_hash = fact.d_un.d_ptr;
    }
  }

  /// How many symbols there are, by the table in which the dynamic linker looks for them.
  std::uint64_t count_symbols() {
    if (facts_.gnu_hash == 0) {  // buckets, symbols
      const auto counts = read_at_address<std::uint32_t>(facts_.hash, 2);
      return facts_.hash == 0 || counts.empty() ? 0 : counts[1];
    }
    // buckets, first symbol, words of a filter; the filter, the first symbol of each bucket; for each
    // symbol a word that is odd at the end of its bucket
    const auto head = read_at_address<std::uint32_t>(facts_.gnu_hash, 4);
    if (head.empty()) return 0;
    const std::uint64_t buckets =
        facts_.gnu_hash + 4 * sizeof(std::uint32_t) + std::uint64_t{head[2]} * sizeof(ElfW(Addr));
    std::uint32_t last = 0;
    for (const std::uint32_t first : read_at_address<std::uint32_t>(buckets, head[0])) {
      last = std::max(last, first);
    }
    if (last < head[1]) return head[1];
    const std::uint64_t chains = buckets + std::uint64_t{head[0]} * sizeof(std::uint32_t);
    for (std::uint64_t i = last; i < kMostBytes; ++i) {
      const auto word =
          read_at_address<std::uint32_t>(chains + (i - head[1]) * sizeof(std::uint32_t), 1);
      if (word.empty()) return 0;
      if ((word[0] & 1U) != 0) return i + 1;
    }
    return 0;
  }

  bool read_among(std::string_view name, std::span<std::byte> value) {
    const std::vector<char> names = read_at_address<char>(facts_.names, facts_.size_of_names);
    for (const Symbol& symbol : read_at_address<Symbol>(facts_.symbols, count_symbols())) {
      if (symbol.st_name >= names.size() || symbol.st_shndx == SHN_UNDEF) continue;
      const std::string_view rest(names.data() + symbol.st_name, names.size() - symbol.st_name);
      if (rest.substr(0, rest.find('\0')) != name) continue;
      const std::vector<std::byte> bytes =
          read_at_address<std::byte>(symbol.st_value, value.size());
      std::copy(bytes.begin(), bytes.end(), value.begin());
      return !bytes.empty();
    }
    return false;
  }

  std::ifstream in_;
  std::uint64_t size_ = 0;
  std::vector<Segment> segments_;
  struct {  // addresses, but for the size
    std::uint64_t symbols = 0, names = 0, size_of_names = 0, hash = 0, gnu_hash = 0;
  } facts_;
};

}  // namespace

ConstantSearch read_constant(const std::filesystem::path& file, std::string_view symbol,
                             std::span<std::byte> value) {
  return ElfFile(file).read_constant(symbol, value);
}
#else
// Files of macOS are not ELF: what they say is found out when they are loaded.
ConstantSearch read_constant(const std::filesystem::path&, std::string_view, std::span<std::byte>) {
  return ConstantSearch::no_answer;
}
#endif

}  // namespace tetmend::platform
#endif
