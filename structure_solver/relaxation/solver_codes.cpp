#include "structure_solver/relaxation/solver_codes.hpp"

#include <array>

#include <cvode/cvode.h>
#include <kinsol/kinsol.h>

namespace standoff::structure {
namespace {

using enum SolverAction;

constexpr std::array cvode_table{
    SolverCode{CV_SUCCESS, "CV_SUCCESS", "step taken", proceed},
    SolverCode{CV_TSTOP_RETURN, "CV_TSTOP_RETURN", "step taken, stop time reached", proceed},
    SolverCode{CV_ROOT_RETURN, "CV_ROOT_RETURN", "step taken, a root was found", proceed},
    SolverCode{CV_WARNING, "CV_WARNING", "step taken, with a warning", proceed},
    SolverCode{CV_TOO_MUCH_WORK, "CV_TOO_MUCH_WORK", "step limit of one call reached", raise_limits},
    SolverCode{CV_TOO_MUCH_ACC, "CV_TOO_MUCH_ACC", "tolerance below what rounding allows", loosen},
    SolverCode{CV_ERR_FAILURE, "CV_ERR_FAILURE", "error test failed too often, or smallest step reached", shorten},
    SolverCode{CV_CONV_FAILURE, "CV_CONV_FAILURE", "Newton iteration did not converge at any step size", refactor},
    SolverCode{CV_LINIT_FAIL, "CV_LINIT_FAIL", "linear solver could not be initialised", stop},
    SolverCode{CV_LSETUP_FAIL, "CV_LSETUP_FAIL", "preconditioner could not be set up", refactor},
    SolverCode{CV_LSOLVE_FAIL, "CV_LSOLVE_FAIL", "linear solve broke down", refactor},
    SolverCode{CV_RHSFUNC_FAIL, "CV_RHSFUNC_FAIL", "the force failed beyond repair", stop},
    SolverCode{CV_FIRST_RHSFUNC_ERR, "CV_FIRST_RHSFUNC_ERR", "no force at the starting state", stop},
    SolverCode{CV_REPTD_RHSFUNC_ERR, "CV_REPTD_RHSFUNC_ERR", "no force (inverted element) at any step size", shorten},
    SolverCode{CV_UNREC_RHSFUNC_ERR, "CV_UNREC_RHSFUNC_ERR", "no force, and no shorter step possible", shorten},
    SolverCode{CV_RTFUNC_FAIL, "CV_RTFUNC_FAIL", "root function failed", stop},
    SolverCode{CV_NLS_INIT_FAIL, "CV_NLS_INIT_FAIL", "Newton solver could not be initialised", stop},
    SolverCode{CV_NLS_SETUP_FAIL, "CV_NLS_SETUP_FAIL", "Newton solver could not be set up", refactor},
    SolverCode{CV_CONSTR_FAIL, "CV_CONSTR_FAIL", "inequality constraint not met", fall_back},
    SolverCode{CV_NLS_FAIL, "CV_NLS_FAIL", "Newton solver failed beyond repair", refactor},
    SolverCode{CV_MEM_FAIL, "CV_MEM_FAIL", "memory exhausted", stop},
    SolverCode{CV_MEM_NULL, "CV_MEM_NULL", "no solver object", stop},
    SolverCode{CV_ILL_INPUT, "CV_ILL_INPUT", "a setting is illegal", stop},
    SolverCode{CV_NO_MALLOC, "CV_NO_MALLOC", "solver object not initialised", stop},
    SolverCode{CV_BAD_K, "CV_BAD_K", "illegal derivative order", stop},
    SolverCode{CV_BAD_T, "CV_BAD_T", "time outside the last step", stop},
    SolverCode{CV_BAD_DKY, "CV_BAD_DKY", "no vector for the derivative", stop},
    SolverCode{CV_TOO_CLOSE, "CV_TOO_CLOSE", "start and end time too close for a first step", shorten},
    SolverCode{CV_VECTOROP_ERR, "CV_VECTOROP_ERR", "a vector operation failed", fall_back},
    SolverCode{CV_PROJ_MEM_NULL, "CV_PROJ_MEM_NULL", "no projection object", stop},
    SolverCode{CV_PROJFUNC_FAIL, "CV_PROJFUNC_FAIL", "projection failed", stop},
    SolverCode{CV_REPTD_PROJFUNC_ERR, "CV_REPTD_PROJFUNC_ERR", "projection failed at every step size", stop},
    SolverCode{CV_CONTEXT_ERR, "CV_CONTEXT_ERR", "objects of different contexts mixed", stop},
    SolverCode{CV_UNRECOGNIZED_ERR, "CV_UNRECOGNIZED_ERR", "an error CVODE itself does not know", stop},
};

constexpr std::array kinsol_table{
    SolverCode{KIN_SUCCESS, "KIN_SUCCESS", "residual below its tolerance", judge},
    SolverCode{KIN_INITIAL_GUESS_OK, "KIN_INITIAL_GUESS_OK", "in equilibrium already", judge},
    SolverCode{KIN_STEP_LT_STPTOL, "KIN_STEP_LT_STPTOL", "steps have become negligible", judge},
    SolverCode{KIN_WARNING, "KIN_WARNING", "ended with a warning", judge},
    SolverCode{KIN_MEM_NULL, "KIN_MEM_NULL", "no solver object", stop},
    SolverCode{KIN_ILL_INPUT, "KIN_ILL_INPUT", "a setting is illegal", stop},
    SolverCode{KIN_NO_MALLOC, "KIN_NO_MALLOC", "solver object not initialised", stop},
    SolverCode{KIN_MEM_FAIL, "KIN_MEM_FAIL", "memory exhausted", stop},
    SolverCode{KIN_LINESEARCH_NONCONV, "KIN_LINESEARCH_NONCONV", "line search found no lower residual", judge},
    SolverCode{KIN_MAXITER_REACHED, "KIN_MAXITER_REACHED", "iteration limit reached", judge},
    SolverCode{KIN_MXNEWT_5X_EXCEEDED, "KIN_MXNEWT_5X_EXCEEDED", "five Newton steps longer than allowed", fall_back},
    SolverCode{KIN_LINESEARCH_BCFAIL, "KIN_LINESEARCH_BCFAIL", "line search failed its slope condition", judge},
    SolverCode{KIN_LINSOLV_NO_RECOVERY, "KIN_LINSOLV_NO_RECOVERY", "linear solve failed with a fresh factor",
               fall_back},
    SolverCode{KIN_LINIT_FAIL, "KIN_LINIT_FAIL", "linear solver could not be initialised", stop},
    SolverCode{KIN_LSETUP_FAIL, "KIN_LSETUP_FAIL", "preconditioner could not be set up", fall_back},
    SolverCode{KIN_LSOLVE_FAIL, "KIN_LSOLVE_FAIL", "linear solve broke down", fall_back},
    SolverCode{KIN_SYSFUNC_FAIL, "KIN_SYSFUNC_FAIL", "the force failed beyond repair", fall_back},
    SolverCode{KIN_FIRST_SYSFUNC_ERR, "KIN_FIRST_SYSFUNC_ERR", "no force at the starting state", fall_back},
    SolverCode{KIN_REPTD_SYSFUNC_ERR, "KIN_REPTD_SYSFUNC_ERR", "no force (inverted element) at any step length",
               fall_back},
    SolverCode{KIN_VECTOROP_ERR, "KIN_VECTOROP_ERR", "a vector operation failed", fall_back},
    SolverCode{KIN_CONTEXT_ERR, "KIN_CONTEXT_ERR", "objects of different contexts mixed", stop},
};

template <class Table>
const SolverCode& find(const Table& table, int code, const SolverCode& unknown) {
  for (const SolverCode& entry : table)
    if (entry.code == code) return entry;
  return unknown;
}

}  // namespace

std::span<const SolverCode> cvode_codes() {
  return cvode_table;
}

std::span<const SolverCode> kinsol_codes() {
  return kinsol_table;
}

const SolverCode& cvode_code(int code) {
  static constexpr SolverCode unknown{0, "unknown CVODE code", "not a code of SUNDIALS 6.4", stop};
  return find(cvode_table, code, unknown);
}

const SolverCode& kinsol_code(int code) {
  static constexpr SolverCode unknown{0, "unknown KINSOL code", "not a code of SUNDIALS 6.4", stop};
  return find(kinsol_table, code, unknown);
}

std::string_view words_for(SolverAction action) {
  switch (action) {
    case proceed:
      return "going on";
    case judge:
      return "judged by the measured residual";
    case raise_limits:
      return "allowing more steps";
    case loosen:
      return "asking for less accuracy";
    case refactor:
      return "assembling and factoring the stiffness again";
    case shorten:
      return "restarting with a shorter step";
    case fall_back:
      return "falling back";
    case stop:
      return "stopping";
  }
  return "";
}

}  // namespace standoff::structure
