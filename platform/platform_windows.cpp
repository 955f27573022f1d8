// SPDX-License-Identifier: MIT
// Windows, from version 7 on, through the C runtime and the functions of the system.
#ifdef _WIN32
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <system_error>

#include "platform/child.h"
#include "platform/memory.h"
#include "platform/platform.h"

#define WIN32_LEAN_AND_MEAN
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define PSAPI_VERSION 2
#include <fcntl.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>
#include <windows.h>
// After windows.h
#include <psapi.h>
#include <shellapi.h>

namespace tetmend::platform {
namespace {

/// What errno would say of the last failure of the system.
int last_error() {
  switch (::GetLastError()) {
    case ERROR_SUCCESS:
      return 0;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_INVALID_DRIVE:
    case ERROR_BAD_PATHNAME:
    case ERROR_BAD_NETPATH:
      return ENOENT;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
    case ERROR_USER_MAPPED_FILE:
      return EACCES;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      return EEXIST;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
      return ENOSPC;
    case ERROR_NOT_ENOUGH_MEMORY:
    case ERROR_OUTOFMEMORY:
      return ENOMEM;
    case ERROR_FILENAME_EXCED_RANGE:
      return ENAMETOOLONG;
    case ERROR_TOO_MANY_OPEN_FILES:
      return EMFILE;
    case ERROR_WRITE_PROTECT:
      return EROFS;
    case ERROR_NOT_SUPPORTED:
    case ERROR_INVALID_FUNCTION:
      return ENOTSUP;
    default:
      return EIO;
  }
}

bool is_folder(const std::filesystem::path& file) {
  const DWORD attributes = ::GetFileAttributesW(file.c_str());
  return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

bool is_link(const std::filesystem::path& file) {
  const DWORD attributes = ::GetFileAttributesW(file.c_str());
  return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
}

/// Others may delete or rename it meanwhile, as elsewhere: a signal removes a file that is open.
Answer<Descriptor> open(const std::filesystem::path& file, DWORD access, DWORD disposition,
                        DWORD flags, int mode) {
  constexpr DWORD kShare = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const HANDLE handle =
      ::CreateFileW(file.c_str(), access, kShare, nullptr, disposition, flags, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return {Descriptor(), last_error()};
  const int number =
      ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), mode | _O_BINARY | _O_NOINHERIT);
  if (number >= 0) return {Descriptor(number), 0};
  const int error = errno;
  ::CloseHandle(handle);
  return {Descriptor(), error};
}

Answer<FileFacts> facts_of(int result, const struct _stat64& info) {
  if (result != 0) return {{}, errno};
  FileFacts facts;
  if ((info.st_mode & _S_IFMT) == _S_IFREG) facts.kind = FileKind::regular;
  if ((info.st_mode & _S_IFMT) == _S_IFDIR) facts.kind = FileKind::folder;
  facts.size = static_cast<std::uint64_t>(info.st_size);
  facts.names = static_cast<std::uint64_t>(std::max<int>(info.st_nlink, 1));
  return {facts, 0};
}

/// The most that one call of the C runtime takes.
unsigned in_one_call(std::size_t size) {
  return static_cast<unsigned>(std::min(size, std::size_t{1} << 30));
}

std::string in_utf8(std::wstring_view text) {
  const auto size = static_cast<int>(text.size());
  if (size == 0) return {};
  const int room =
      ::WideCharToMultiByte(CP_UTF8, 0, text.data(), size, nullptr, 0, nullptr, nullptr);
  std::string utf8(static_cast<std::size_t>(room), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, text.data(), size, utf8.data(), room, nullptr, nullptr);
  return utf8;
}

}  // namespace

// ---- files

int Descriptor::close() noexcept {
  if (!is_open()) return 0;
  return ::_close(std::exchange(number_, kNone)) == 0 ? 0 : errno;
}

Answer<Descriptor> open_to_read(const std::filesystem::path& file, Links links) {
  if (is_folder(file)) return {Descriptor(), EISDIR};
  if (links == Links::refused && is_link(file)) return {Descriptor(), ELOOP};
  return open(file, GENERIC_READ, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, _O_RDONLY);
}

// Who may do what with it is inherited from the folder.
Answer<Descriptor> create(const std::filesystem::path& file, Access) {
  return open(file, GENERIC_WRITE | DELETE, CREATE_NEW,
              FILE_ATTRIBUTE_NORMAL | FILE_FLAG_OPEN_REPARSE_POINT, _O_WRONLY);
}

Answer<Descriptor> open_to_append(const std::filesystem::path& file) {
  if (is_link(file)) return {Descriptor(), ELOOP};
  return open(file, FILE_APPEND_DATA, OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, _O_WRONLY | _O_APPEND);
}

Answer<Descriptor> create_nameless() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) return {Descriptor(), error.value()};
  for (int attempt = 0;; ++attempt) {
    const auto file = folder / ("tetmend-" + std::to_string(process_number()) + "-" +
                                std::to_string(attempt) + ".tmp");
    Answer<Descriptor> made = open(file, GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_NEW,
                                   FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, _O_RDWR);
    if (made.error != EEXIST) return made;
  }
}

Answer<FileFacts> look_at(int file) {
  struct _stat64 info {};
  return facts_of(::_fstat64(file, &info), info);
}

Answer<FileFacts> look_at(const std::filesystem::path& file) {
  struct _stat64 info {};
  Answer<FileFacts> facts = facts_of(::_wstat64(file.c_str(), &info), info);
  if (!facts || facts.value.kind != FileKind::regular) return facts;
  // By its name the C runtime counts no names.
  const Answer<Descriptor> opened = open_to_read(file);
  BY_HANDLE_FILE_INFORMATION more{};
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(opened.value.number()));
  if (opened && ::GetFileInformationByHandle(handle, &more) != 0) {
    facts.value.names = std::max<DWORD>(more.nNumberOfLinks, 1);
  }
  return facts;
}

Answer<FileFacts> look_at_name(const std::filesystem::path& file) {
  const DWORD attributes = ::GetFileAttributesW(file.c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES) return {{}, last_error()};
  if ((attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0) return {FileFacts(), 0};
  return look_at(file);
}

int may_write(const std::filesystem::path& file) {
  constexpr int kWrite = 2;
  return ::_waccess(file.c_str(), kWrite) == 0 ? 0 : errno;
}

Answer<std::size_t> read_some(int file, std::span<char> buffer) {
  const int got = ::_read(file, buffer.data(), in_one_call(buffer.size()));
  if (got < 0) return {0, errno};
  return {static_cast<std::size_t>(got), 0};
}

Answer<std::size_t> read_at(int file, std::uint64_t place, std::span<char> buffer) {
  if (::_lseeki64(file, static_cast<std::int64_t>(place), SEEK_SET) < 0) return {0, errno};
  return read_some(file, buffer);
}

int write_fully(int file, std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const int written = ::_write(file, bytes.data(), in_one_call(bytes.size()));
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int synchronise(int file) {
  return ::_commit(file) == 0 ? 0 : errno;
}

// A rename waits until the disk has the name.
int synchronise_folder(const std::filesystem::path&) {
  return 0;
}

/// Of a byte far behind the end: what a lock covers, nobody else may read.
Answer<Descriptor> open_locked(const std::filesystem::path& file, Sharing sharing) {
  if (is_link(file)) return {Descriptor(), ELOOP};
  auto opened =
      open(file, GENERIC_READ | GENERIC_WRITE, OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, _O_RDWR);
  if (!opened) return opened;
  OVERLAPPED place{};
  place.OffsetHigh = 1;
  const DWORD kind =
      LOCKFILE_FAIL_IMMEDIATELY | (sharing == Sharing::none ? LOCKFILE_EXCLUSIVE_LOCK : 0);
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(opened.value.number()));
  if (::LockFileEx(handle, kind, 0, 1, 0, &place) == 0) {
    opened.error = ::GetLastError() == ERROR_LOCK_VIOLATION ? EWOULDBLOCK : ENOLCK;
  }
  return opened;
}

// A new file has those of its folder, which is what Windows users expect.
OwnerLoss keep_owner(int, const FileFacts&, const FileFacts&) {
  return {};
}

int rename(const std::filesystem::path& from, const std::filesystem::path& to) {
  constexpr DWORD kFlags = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
  if (::MoveFileExW(from.c_str(), to.c_str(), kFlags) != 0) return 0;
  const int error = last_error();
  return is_folder(to) ? EISDIR : error;
}

int add_name(const std::filesystem::path& file, const std::filesystem::path& name) {
  return ::CreateHardLinkW(name.c_str(), file.c_str(), nullptr) != 0 ? 0 : last_error();
}

void remove_file(const wchar_t* file) noexcept {
  ::DeleteFileW(file);
}

// ---- the program: streams, arguments, environment

void reserve_standard_streams() noexcept {
  constexpr int kAnyMode = _O_RDWR;
  for (const int number : {kStandardInput, kStandardOutput, kStandardError}) {
    // The lowest free number is this one, for those below are taken.
    if (::_get_osfhandle(number) < 0) ::_open("NUL", kAnyMode);
    ::_setmode(number, _O_BINARY);
  }
}

bool is_terminal(int file) noexcept {
  DWORD mode = 0;
  return ::GetConsoleMode(reinterpret_cast<HANDLE>(::_get_osfhandle(file)), &mode) != 0;
}

std::size_t terminal_columns() noexcept {
  CONSOLE_SCREEN_BUFFER_INFO info{};
  const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
  if (::GetConsoleScreenBufferInfo(console, &info) == 0) return 0;
  return static_cast<std::size_t>(info.srWindow.Right - info.srWindow.Left + 1);
}

std::vector<std::string> arguments(int count, char** words) {
  int wide_count = 0;
  wchar_t** wide = ::CommandLineToArgvW(::GetCommandLineW(), &wide_count);
  if (wide == nullptr) return {words, words + count};
  std::vector<std::string> list;
  for (int i = 0; i < wide_count; ++i) list.push_back(in_utf8(wide[i]));
  ::LocalFree(wide);
  return list;
}

std::string trusted_variable(const char* name) {
  const wchar_t* value = ::_wgetenv(std::filesystem::path(name).c_str());
  return value == nullptr ? "" : in_utf8(value);
}

const char kPathSeparator = ';';

std::filesystem::path program_file() {
  std::wstring name(1 << 15, L'\0');
  const DWORD size = ::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size()));
  name.resize(size);
  return name;
}

unsigned process_number() noexcept {
  return ::GetCurrentProcessId();
}

std::string host_name() {
  std::wstring name(MAX_COMPUTERNAME_LENGTH + 1, L'\0');
  auto size = static_cast<DWORD>(name.size());
  if (::GetComputerNameW(name.data(), &size) == 0) return {};
  return in_utf8(std::wstring_view(name).substr(0, size));
}

// ---- signals

namespace {

// A signal handler can reach nothing but globals.
std::atomic<SignalHandler> end_handler{nullptr};
std::atomic<SignalHandler> crash_handler{nullptr};
static_assert(std::atomic<SignalHandler>::is_always_lock_free);

/// Runs in a thread of its own. What closes the console, logs off or shuts down leaves some seconds.
BOOL WINAPI on_console(DWORD event) {
  end_handler.load()(event == CTRL_C_EVENT ? SIGINT : SIGTERM);
  return TRUE;
}

LONG WINAPI on_exception(EXCEPTION_POINTERS* exception) {
  switch (exception->ExceptionRecord->ExceptionCode) {
    case EXCEPTION_ILLEGAL_INSTRUCTION:
      crash_handler.load()(SIGILL);
      break;
    case EXCEPTION_INT_DIVIDE_BY_ZERO:
    case EXCEPTION_FLT_INVALID_OPERATION:
      crash_handler.load()(SIGFPE);
      break;
    default:
      crash_handler.load()(SIGSEGV);
  }
  return EXCEPTION_CONTINUE_SEARCH;  // it ends as it would have
}

void on_abort(int number) {
  crash_handler.load()(number);
  end_by_default(number);
}

}  // namespace

void on_end_signals(EndSignals, SignalHandler handler) noexcept {
  end_handler = handler;
  ::SetConsoleCtrlHandler(on_console, TRUE);
}

bool comes_again(int) noexcept {
  return false;
}

void end_by_default(int number) noexcept {
  ::signal(number, SIG_DFL);
  ::raise(number);
}

// Writing to a broken pipe, or beyond a limit, is an error of the stream anyway.
void ignore_broken_pipes() noexcept {}
void ignore_file_limits() noexcept {}

void on_crashes(SignalHandler handler) noexcept {
  crash_handler = handler;
  ::SetUnhandledExceptionFilter(on_exception);
  ::signal(SIGABRT, on_abort);
}

void provide_crash_stack() {
  ULONG size = 1 << 16;
  ::SetThreadStackGuarantee(&size);
}

// ---- other programs

namespace {

/// As programs of Microsoft's C runtime take a command line apart.
std::wstring quoted(const std::wstring& word) {
  std::wstring result = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t c : word) {
    if (c == L'"') result.append(backslashes + 1, L'\\');
    backslashes = c == L'\\' ? backslashes + 1 : 0;
    result += c;
  }
  return result.append(backslashes, L'\\') + L"\"";
}

HANDLE inherited(int file) {
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(file));
  ::SetHandleInformation(handle, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  return handle;
}

}  // namespace

Child::Child(const std::vector<std::string>& arguments) {
  constexpr unsigned kRoom = 1 << 16;
  Answer<Descriptor> complaints = create_nameless();
  std::array<int, 2> ends{};
  error_ = complaints.error;
  if (error_ == 0 && ::_pipe(ends.data(), kRoom, _O_BINARY | _O_NOINHERIT) != 0) error_ = errno;
  if (error_ != 0) return;
  complaints_ = std::move(complaints.value);
  const Descriptor output(ends[0]);
  input_ = Descriptor(ends[1]);
  const Descriptor nothing(::_wopen(L"NUL", _O_WRONLY | _O_NOINHERIT));
  std::wstring line;
  for (const std::string& word : arguments) {
    line += (line.empty() ? L"" : L" ") + quoted(std::filesystem::u8path(word).wstring());
  }
  STARTUPINFOW start{};
  start.cb = sizeof start;
  start.dwFlags = STARTF_USESTDHANDLES;
  start.hStdInput = inherited(output.number());
  start.hStdOutput = inherited(nothing.number());
  start.hStdError = inherited(complaints_.number());
  PROCESS_INFORMATION process{};
  if (::CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, CREATE_NO_WINDOW, nullptr,
                       nullptr, &start, &process) == 0) {
    error_ = last_error();
    return;
  }
  ::CloseHandle(process.hThread);
  process_ = reinterpret_cast<std::intptr_t>(process.hProcess);
}

int Child::wait() noexcept {
  input_.close();
  if (process_ == 0) return status_;
  const auto process = reinterpret_cast<HANDLE>(process_);
  ::WaitForSingleObject(process, INFINITE);
  DWORD status = 1;
  ::GetExitCodeProcess(process, &status);
  ::CloseHandle(process);
  process_ = 0;
  status_ = static_cast<int>(status);
  return status_;
}

// ---- memory

std::size_t peak_memory() noexcept {
  PROCESS_MEMORY_COUNTERS counters{};
  if (::GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters) == 0) return 0;
  return counters.PeakWorkingSetSize;
}

std::uint64_t memory_for_process() noexcept {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  if (::GlobalMemoryStatusEx(&status) == 0) return UINT64_MAX;
  return status.ullTotalPhys;
}

void trim_heap() noexcept {}
void give_back_blocks_from(int) noexcept {}

// ---- shared libraries

SharedLibrary::SharedLibrary(const std::filesystem::path& file)
    : file_(file), handle_(::LoadLibraryW(file.c_str())) {}

SharedLibrary::~SharedLibrary() {
  if (handle_ != nullptr) ::FreeLibrary(static_cast<HMODULE>(handle_));
}

void* SharedLibrary::find(const char* symbol) const {
  return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(handle_), symbol));
}

void SharedLibrary::pin() const {
  HMODULE pinned = nullptr;
  ::GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_PIN, file_.c_str(), &pinned);
}

std::string loading_error() {
  const auto code = static_cast<int>(::GetLastError());
  return code == 0 ? "unknown reason" : std::system_category().message(code);
}

bool is_library_name(const std::filesystem::path& file) {
  return file.extension() == ".dll";
}

// What a library says of itself is found out when it is loaded.
ConstantSearch read_constant(const std::filesystem::path&, std::string_view, std::span<std::byte>) {
  return ConstantSearch::no_answer;
}

// A library names the one that it takes a symbol from.
void show_names_of_library(const void*) {}

}  // namespace tetmend::platform
#endif
