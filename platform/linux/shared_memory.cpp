// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/shared_memory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

#include "pago/core/error.hpp"

namespace pago::platform {

namespace {

constexpr mode_t kReadableByAll = 0644;

[[noreturn]] void fail(const std::string& name, const std::string& what, int error) {
  throw Error("shared memory " + name, what + ": " + std::generic_category().message(error));
}

int open_shared(const std::string& name) {
  const int fd = shm_open(("/" + name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kReadableByAll);
  if (fd < 0) fail(name, "cannot be opened", errno);
  return fd;
}

bool has_content(int fd) {
  struct stat about {};
  return fstat(fd, &about) == 0 && about.st_size > 0;
}

void end_readers(int fd) {
  constexpr std::uint32_t kOver = 0;
  if (pwrite(fd, &kOver, sizeof kOver, 0) < 0) return;  // nobody can be told; they see that no news come
}

/// The lock tells whether the owner lives: it goes with the process, however that ends.
int open_owned(const std::string& name) {
  int fd = open_shared(name);
  const auto is_mine = [&fd] { return flock(fd, LOCK_EX | LOCK_NB) == 0; };
  if (is_mine() && has_content(fd)) {
    end_readers(fd);
    shm_unlink(("/" + name).c_str());
    close(fd);
    fd = open_shared(name);
  }
  if (is_mine()) return fd;
  close(fd);
  throw Error("shared memory " + name, "another running process publishes there",
              "stop it, or choose another name: publish.shared_memory");
}

}  // namespace

SharedMemory::SharedMemory(const std::string& name, std::size_t bytes) : name_(name), bytes_(bytes) {
  if (name.find('/') != std::string::npos || name.size() > 200)
    throw Error("shared memory " + name, "is no valid name", "letters, digits, - and _, no slash");
  if (!name.empty()) {
    fd_ = open_owned(name);
    if (ftruncate(fd_, static_cast<off_t>(bytes)) != 0) {
      const int error = errno;
      close(fd_);
      fail(name, "cannot be made large enough", error);
    }
  }
  const int flags = name.empty() ? MAP_PRIVATE | MAP_ANONYMOUS : MAP_SHARED;
  data_ = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, flags | MAP_POPULATE, fd_, 0);
  if (data_ != MAP_FAILED) return;
  const int error = errno;
  if (fd_ >= 0) close(fd_);
  fail(name, "cannot be mapped", error);
}

SharedMemory::~SharedMemory() {
  munmap(data_, bytes_);
  if (fd_ < 0) return;
  shm_unlink(("/" + name_).c_str());
  close(fd_);
}

}  // namespace pago::platform
