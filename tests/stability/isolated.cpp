// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "isolated.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>

namespace swiftlet::stability {
namespace {

[[noreturn]] void run_and_send(int pipe_end, int seconds, const std::function<Findings()>& trial) {
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  signal(SIGALRM, SIG_DFL);
  alarm(unsigned(seconds));
  Findings findings;
  try {
    findings = trial();
  } catch (const std::exception& error) {
    findings.add(Fault::NoNumber, std::string("exception: ") + error.what());
  } catch (...) {
    findings.add(Fault::NoNumber, "an exception of unknown type");
  }
  const bool sent = write(pipe_end, &findings, sizeof findings) == ssize_t(sizeof findings);  // less than PIPE_BUF: at once
  _exit(sent ? 0 : 1);
}
static_assert(sizeof(Findings) <= 512);

/// Whether all of it arrived.
bool receive(int pipe_end, Findings& findings) {
  ssize_t count;
  do count = read(pipe_end, &findings, sizeof findings);
  while (count < 0 && errno == EINTR);
  return count == ssize_t(sizeof findings);
}

}  // namespace

Findings isolated(int seconds, const std::function<Findings()>& trial) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    close(ends[0]);
    run_and_send(ends[1], seconds, trial);
  }
  close(ends[1]);
  Findings findings;
  const bool arrived = receive(ends[0], findings);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (arrived) return findings;
  findings = {};
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    findings.not_terminated = true;
    findings.note("no answer after " + std::to_string(seconds) + " s");
  } else {
    findings.add(Fault::NoNumber, "died of signal " + std::to_string(WIFSIGNALED(status) ? WTERMSIG(status) : 0));
  }
  return findings;
}

}  // namespace swiftlet::stability
