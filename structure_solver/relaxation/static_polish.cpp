#include "structure_solver/relaxation/static_polish.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/core.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include "structure_solver/relaxation/solver_codes.hpp"
#include "structure_solver/relaxation/sundials_objects.hpp"

namespace standoff::structure {
namespace {

constexpr int krylov_dimension = 40;

struct StaticSolve {
  DampedMotion& motion;
  const StiffnessFactor& stiffness;
  CallbackGuard guard;
  std::vector<double> force, shifted, shifted_force;  // force belongs to the u of the last new_u

  int residual(N_Vector u, N_Vector f) { return motion.static_force(values_of(u), values_of(f)) ? 0 : 1; }

  /// K(u) x by a difference of forces; same step as in the damped motion.
  int jacobian_times(N_Vector x, N_Vector product, N_Vector u, booleantype* new_u) {
    if (*new_u && !motion.static_force(values_of(u), force)) return 1;
    *new_u = SUNFALSE;
    const std::span<double> direction = values_of(x), at = values_of(u), result = values_of(product);
    const double largest = N_VMaxNorm(x);
    if (largest == 0.0) {
      N_VConst(0.0, product);
      return 0;
    }
    const double step = 1e-5 * motion.length_scale() / largest;
    for (std::size_t i = 0; i < at.size(); ++i) shifted[i] = at[i] + step * direction[i];
    if (!motion.static_force(shifted, shifted_force)) return 1;
    for (std::size_t i = 0; i < at.size(); ++i) result[i] = (shifted_force[i] - force[i]) / step;
    return 0;
  }

  int precondition(N_Vector v) {
    stiffness.solve(values_of(v), values_of(v));
    return 0;
  }
};

StaticSolve& self(void* data) {
  return *static_cast<StaticSolve*>(data);
}

void require(int flag, const char* what) {
  if (flag != KIN_SUCCESS)
    throw Stop(ExitCode::guard, fmt::format("relaxation: {} failed with {}", what, kinsol_code(flag).name));
}

KinsolMemory create(const SolverContext& context, N_Vector u, SUNLinearSolver linear, StaticSolve& solve) {
  const auto residual = [](N_Vector at, N_Vector f, void* data) {
    return self(data).guard.run([&] { return self(data).residual(at, f); });
  };
  const auto times = [](N_Vector x, N_Vector product, N_Vector at, booleantype* new_u, void* data) {
    return self(data).guard.run([&] { return self(data).jacobian_times(x, product, at, new_u); });
  };
  const auto precondition = [](N_Vector, N_Vector, N_Vector, N_Vector, N_Vector v, void* data) {
    return self(data).guard.run([&] { return self(data).precondition(v); });
  };
  KinsolMemory kinsol(KINCreate(context));
  if (!kinsol) throw Stop(ExitCode::out_of_resources, "relaxation: no memory for KINSOL");
  void* memory = kinsol.get();
  const RelaxationOptions& options = solve.motion.options();
  require(KINSetErrHandlerFn(memory, CallbackGuard::collect, &solve.guard), "KINSetErrHandlerFn");
  require(KINSetNumMaxIters(memory, options.polish_iterations), "KINSetNumMaxIters");
  require(KINInit(memory, residual, u), "KINInit");
  require(KINSetUserData(memory, &solve), "KINSetUserData");
  require(KINSetFuncNormTol(memory, options.polish_residual), "KINSetFuncNormTol");
  require(KINSetScaledStepTol(memory, 1e-12), "KINSetScaledStepTol");
  // The default limit is 1000 times the starting guess, whatever that is; near rest no component moves by a tenth of
  // the size.
  require(KINSetMaxNewtonStep(memory, 0.1 * std::sqrt(static_cast<double>(N_VGetLength(u)))), "KINSetMaxNewtonStep");
  require(KINSetEtaForm(memory, KIN_ETACONSTANT), "KINSetEtaForm");
  require(KINSetEtaConstValue(memory, 1e-3), "KINSetEtaConstValue");
  require(KINSetLinearSolver(memory, linear, nullptr), "KINSetLinearSolver");
  require(KINSetPreconditioner(memory, nullptr, precondition), "KINSetPreconditioner");
  require(KINSetJacTimesVecFn(memory, times), "KINSetJacTimesVecFn");
  return kinsol;
}

double largest(std::span<const double> values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

/// Residual at u with the history as it is, infinite without a force.
double residual_at(DampedMotion& motion, std::span<const double> u, std::vector<double>& force) {
  return motion.static_force(u, force) ? largest(force) : std::numeric_limits<double>::infinity();
}

void judge(DampedMotion& motion, const SolverCode& code, std::span<const double> u, std::vector<double>& scratch,
           PolishEnd& end) {
  const double reached = residual_at(motion, u, scratch);
  const bool usable = code.action == SolverAction::judge && std::isfinite(reached);
  const bool better = reached < end.residual_before || reached <= motion.options().polish_residual;
  const bool good = reached < motion.options().rest_residual;
  end.accepted = usable && better && good;
  if (!end.accepted) {
    end.message = fmt::format("KINSOL: {} ({}), residual {:.3g} N from {:.3g} N: not accepted, nothing was changed",
                              code.name, code.meaning, reached, end.residual_before);
    return;
  }
  const double before = motion.problem().centre_deflection(motion.displacement());
  motion.accept_static(u);
  end.moved = std::abs(motion.problem().centre_deflection(motion.displacement()) - before);
  end.residual = motion.residual();  // of the committed state
  end.message = fmt::format("KINSOL: {} ({}), residual {:.3g} N from {:.3g} N, centre moved {:.3g} um", code.name,
                            code.meaning, end.residual, end.residual_before, end.moved * 1e6);
}

}  // namespace

PolishEnd polish(DampedMotion& motion, StiffnessFactor& stiffness) {
  PolishEnd end;
  const auto size = static_cast<long>(motion.mass().size());
  stiffness.replace(motion.problem().stiffness(motion.displacement()));
  stiffness.factor(1.0, 0.0);
  if (stiffness.shift() > 0.0) end.negative_modes = stiffness.negative_pivots();

  const SolverContext context;
  const SolverVector u(size, context), u_scale(size, context), f_scale(size, context);
  std::ranges::copy(motion.displacement(), u.values().begin());
  N_VConst(1.0 / motion.length_scale(), u_scale);
  N_VConst(1.0, f_scale);  // tolerances are newtons
  const LinearSolver linear(SUNLinSol_SPGMR(u, SUN_PREC_RIGHT, krylov_dimension, context));
  if (!linear) throw Stop(ExitCode::out_of_resources, "relaxation: no memory for the linear solver of KINSOL");
  const auto length = static_cast<std::size_t>(size);
  StaticSolve solve{
      motion, stiffness, {}, std::vector<double>(length), std::vector<double>(length), std::vector<double>(length)};
  end.residual_before = end.residual = residual_at(motion, motion.displacement(), solve.force);
  const KinsolMemory kinsol = create(context, u, linear.get(), solve);

  const SolverCode& code = kinsol_code(KINSol(kinsol.get(), u, KIN_LINESEARCH, u_scale, f_scale));
  solve.guard.rethrow();
  KINGetNumLinIters(kinsol.get(), &end.linear_iterations);
  if (code.action == SolverAction::stop)
    throw Stop(ExitCode::guard,
               fmt::format("relaxation: KINSOL: {} ({}) [{}]", code.name, code.meaning, solve.guard.take_notes()));
  judge(motion, code, u.values(), solve.shifted_force, end);
  if (end.negative_modes > 0)
    end.message += fmt::format(
        "; the stiffness has {} negative eigenvalue(s) here, so this equilibrium is not stable "
        "(preconditioner shifted by {:.3g} rad2/s2)",
        end.negative_modes, stiffness.shift());
  return end;
}

}  // namespace standoff::structure
