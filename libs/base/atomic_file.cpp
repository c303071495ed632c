#include "base/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/error.h"

namespace vsgl {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::write_failed, path.string() + ": " + what);
}

// The temporary files of the process, as a signal handler can read them: a list that only grows; entries are
// switched off when their file is gone.
struct Temporary {
  std::string path;
  std::atomic<bool> exists{true};
  Temporary* next = nullptr;
};
std::atomic<Temporary*> temporaries{nullptr};

void register_temporary(const fs::path& path) {
  auto* entry = new Temporary{.path = path.string()};
  entry->next = temporaries.load();
  while (!temporaries.compare_exchange_weak(entry->next, entry)) {
  }
}

void forget_temporary(const fs::path& path) {
  for (Temporary* t = temporaries.load(); t != nullptr; t = t->next) {
    if (t->path == path.native()) t->exists = false;
  }
}

extern "C" void remove_temporaries_and_exit(int signal_number) {
  for (Temporary* t = temporaries.load(); t != nullptr; t = t->next) {
    if (t->exists) unlink(t->path.c_str());
  }
  _exit(128 + signal_number);
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void sync_path(const fs::path& path, int flags) {
  const int file = open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) fail(path, std::string("cannot be opened for flushing: ") + std::strerror(errno));
  const int result = fsync(file);
  const int reason = errno;
  close(file);
  // EINVAL: the file system has nothing to flush (some network and memory file systems).
  if (result != 0 && reason != EINVAL)
    fail(path, std::string("flushing to disk failed: ") + std::strerror(reason));
}

}  // namespace

void OutputSet::remove_on_signals() {
  struct sigaction action = {};
  action.sa_handler = remove_temporaries_and_exit;
  sigfillset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction inherited = {};
    sigaction(number, nullptr, &inherited);
    if (inherited.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);  // nohup stays in force
  }
}

void OutputSet::check(const fs::path& target, bool overwrite) {
  if (target.filename().empty()) fail(target, "is a folder; name a file");
  const fs::path folder = folder_of(target);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    fail(target, "the folder " + folder.string() + " does not exist; create it first");
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    fail(target, "the folder " + folder.string() + " cannot be written: " + std::strerror(errno));
  }
  const fs::file_status status = fs::status(target, ignored);
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status))
    fail(target, "is there already and is no regular file; choose another name");
  if (!overwrite) {
    throw Error(ErrorCode::output_exists,
                target.string() + ": is there already; give --overwrite to replace it");
  }
}

fs::path OutputSet::add(const fs::path& target) {
  check(target, overwrite_);
  const std::string name =
      "." + target.stem().string() + ".tmp-" + std::to_string(getpid()) + target.extension().string();
  const fs::path temporary = folder_of(target) / name;
  register_temporary(temporary);
  entries_.push_back({target, temporary});
  const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) fail(target, std::string("cannot be created: ") + std::strerror(errno));
  close(file);
  return temporary;
}

void OutputSet::commit() {
  for (const auto& [target, temporary] : entries_) {
    std::error_code error;
    if (fs::file_size(temporary, error) == 0 || error) {
      throw Error(ErrorCode::internal, target.string() + ": was announced as an output but never written");
    }
    sync_path(temporary, O_RDONLY);
  }
  for (const auto& [target, temporary] : entries_) {
    check(target, overwrite_);  // another process may have written it meanwhile
    if (std::rename(temporary.c_str(), target.c_str()) != 0) {
      fail(target, std::string("cannot be renamed into place: ") + std::strerror(errno));
    }
    forget_temporary(temporary);
    sync_path(folder_of(target), O_RDONLY | O_DIRECTORY);
  }
  committed_ = true;
}

OutputSet::~OutputSet() {
  if (committed_) return;
  for (const auto& [target, temporary] : entries_) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    forget_temporary(temporary);
  }
}

std::vector<fs::path> OutputSet::targets() const {
  std::vector<fs::path> targets;
  for (const Entry& entry : entries_) targets.push_back(entry.target);
  return targets;
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) fail(path, std::string("writing failed: ") + std::strerror(errno));
}

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(ErrorCode::file_not_found, path.string() + ": cannot be opened: " + std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  // A folder opens as a stream and fails on the first read.
  std::error_code ignored;
  if (file.bad() || (text.str().empty() && fs::file_size(path, ignored) != 0)) {
    throw Error(ErrorCode::read_failed, path.string() + ": reading failed");
  }
  return text.str();
}

}  // namespace vsgl
