// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "crew.h"

#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

namespace swiftlet::python {
namespace py = pybind11;
namespace {

constexpr auto kBetweenLooks = std::chrono::milliseconds(10);

/// Takes the interpreter's lock. Where the interpreter is ending it would end this thread, a daemon's, by unwinding it, which
/// destructors and handlers do not let through: then the thread stays here until the process ends.
void restore(PyThreadState* state) {
  try {
    PyEval_RestoreThread(state);
  } catch (...) {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
}

}  // namespace

Unlocked::Unlocked(unsigned threads) : state_(PyEval_SaveThread()), threads_(threads), process_(getpid()) {}

Unlocked::~Unlocked() { take_back(); }

void Unlocked::take_back() {
  if (state_) restore(state_), state_ = nullptr;
}

void Unlocked::look() {
  looked_ = Clock::now();
  restore(state_);
  const bool raised = PyErr_CheckSignals() != 0;
  state_ = PyEval_SaveThread();  // what was raised stays with this thread's state
  forked_ = getpid() != process_;
  if (raised || forked_) stopped_ = true;
}

bool Unlocked::stopped() {
  if (!stopped_.load(std::memory_order_relaxed) && std::this_thread::get_id() == owner_ &&
      Clock::now() - looked_ > kBetweenLooks)
    look();
  return stopped_.load(std::memory_order_relaxed);
}

void Unlocked::run(std::size_t count, const std::function<void(std::size_t)>& task) {
  // On the heap: a handler of a signal may fork, and in the child the threads that hold it are gone.
  struct Shared {
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> failed = false;
    std::exception_ptr failure;
    std::mutex mutex;
    std::condition_variable left;
    std::size_t running = 0;
  };
  const auto shared = std::make_shared<Shared>();
  const auto work = [this, count, &task](Shared& all) {
    try {
      for (std::size_t i; !all.failed && !stopped() && (i = all.next.fetch_add(1, std::memory_order_relaxed)) < count;) task(i);
    } catch (...) {
      if (!all.failed.exchange(true)) all.failure = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  const std::size_t more = std::min<std::size_t>(threads_, count) - (count > 0);
  for (std::size_t k = 0; k < more; ++k) {
    try {
      const std::lock_guard<std::mutex> lock(shared->mutex);
      threads.emplace_back([shared, &work] {
        work(*shared);
        const std::lock_guard<std::mutex> leaving(shared->mutex);
        --shared->running;
        shared->left.notify_one();
      });
      ++shared->running;
    } catch (const std::system_error&) {
      break;  // fewer threads do the same work
    }
  }
  work(*shared);
  if (!threads.empty()) {
    std::unique_lock<std::mutex> lock(shared->mutex);
    while (!forked_ && !shared->left.wait_for(lock, kBetweenLooks, [&] { return shared->running == 0; })) {
      lock.unlock();
      stopped();
      lock.lock();
    }
  }
  for (std::thread& thread : threads) {
    if (forked_)
      thread.detach();
    else
      thread.join();
  }
  if (shared->failure) std::rethrow_exception(shared->failure);
}

Executor Unlocked::executor() {
  return [this](std::size_t count, const std::function<void(std::size_t)>& task) { run(count, task); };
}

void Unlocked::finish() {
  take_back();
  if (PyErr_Occurred()) throw py::error_already_set();
  if (forked_) throw std::runtime_error("a handler of a signal forked while a batch ran: in the child it has no answer");
}

}  // namespace swiftlet::python
