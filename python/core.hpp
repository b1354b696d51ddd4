// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <stdexcept>

namespace catena::python {

/// A computation failed; the message is the program's.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Asked often by a long computation without the interpreter's lock: whether to go on. After a
/// Ctrl-C the answer stays no, and rethrow() raises KeyboardInterrupt.
class SignalCheck {
 public:
  bool operator()();
  void rethrow() const;

 private:
  std::chrono::steady_clock::time_point next_{};
  bool raised_ = false;
};

/// Cases, identify and diagnose (studies.cpp).
void add_studies(pybind11::module_& module);

}  // namespace catena::python
