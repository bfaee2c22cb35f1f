#pragma once
// Owners of SUNDIALS objects: each frees what it made, in the right order, whatever way a scope is left. One context
// and one solver per solve: nothing is reused, so no setting or history of an earlier solve can leak into a later one.
// SUNDIALS reports errors by writing to stderr; here the text goes to a string that ends up in the result's message.
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <cvode/cvode.h>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>

#include "coupling/base/stop.hpp"

namespace standoff::structure {

class SolverContext {
 public:
  SolverContext() {
    if (SUNContext_Create(nullptr, &context_) != 0)
      throw Stop(ExitCode::out_of_resources, "relaxation: SUNDIALS could not create a context; is memory exhausted?");
  }
  ~SolverContext() { SUNContext_Free(&context_); }
  SolverContext(const SolverContext&) = delete;
  SolverContext& operator=(const SolverContext&) = delete;
  operator SUNContext() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

/// A serial vector that owns its numbers.
class SolverVector {
 public:
  SolverVector(long length, const SolverContext& context) : vector_(N_VNew_Serial(length, context)) {
    if (vector_ == nullptr) throw Stop(ExitCode::out_of_resources, "relaxation: no memory for a vector");
    N_VConst(0.0, vector_);
  }
  ~SolverVector() { N_VDestroy(vector_); }
  SolverVector(const SolverVector&) = delete;
  SolverVector& operator=(const SolverVector&) = delete;
  operator N_Vector() const { return vector_; }
  std::span<double> values() const {
    return {N_VGetArrayPointer(vector_), static_cast<std::size_t>(N_VGetLength(vector_))};
  }

 private:
  N_Vector vector_;
};

inline std::span<double> values_of(N_Vector vector) {
  return {N_VGetArrayPointer(vector), static_cast<std::size_t>(N_VGetLength(vector))};
}

struct FreeCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};
struct FreeKinsol {
  void operator()(void* memory) const { KINFree(&memory); }
};
struct FreeLinearSolver {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
using CvodeMemory = std::unique_ptr<void, FreeCvode>;
using KinsolMemory = std::unique_ptr<void, FreeKinsol>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, FreeLinearSolver>;

/// Collects what the C library reports, and carries C++ exceptions over its frames: a callback must not throw through
/// C.
class CallbackGuard {
 public:
  /// Runs `body` (an int for SUNDIALS); an exception becomes -1, an unrecoverable failure, and is thrown again by
  /// rethrow().
  template <class Body>
  int run(Body&& body) noexcept {
    try {
      return body();
    } catch (...) {
      error_ = std::current_exception();
      return -1;
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }
  /// Has the signature of both CVErrHandlerFn and KINErrHandlerFn; `guard` is a CallbackGuard.
  static void collect(int, const char* module, const char* function, char* text, void* guard) {
    auto& notes = static_cast<CallbackGuard*>(guard)->notes_;
    if (notes.size() < 2000) notes += std::string(notes.empty() ? "" : "; ") + module + " " + function + ": " + text;
  }
  std::string take_notes() { return std::exchange(notes_, {}); }

 private:
  std::exception_ptr error_;
  std::string notes_;
};

}  // namespace standoff::structure
