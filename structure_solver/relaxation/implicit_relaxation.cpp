#include "structure_solver/relaxation/implicit_relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include "structure_solver/relaxation/leapfrog_relaxation.hpp"
#include "structure_solver/relaxation/solver_codes.hpp"
#include "structure_solver/relaxation/sundials_objects.hpp"

namespace standoff::structure {
namespace {

constexpr int krylov_dimension = 40;  // CVODE's default of 5 silently shortens the step
constexpr double near_enough = 1.25;  // a gamma this close to the factored one is not why GMRES takes long
constexpr double too_far = 30.0;      // beyond this GMRES would not converge within its dimension
constexpr long review = 2000;         // steps after which the gain over an explicit integrator is looked at
constexpr int patience = 3;           // restarts without 20 accepted steps in between

class ImplicitMotion {
 public:
  ImplicitMotion(DampedMotion& motion, StiffnessFactor& stiffness)
      : motion_(motion),
        stiffness_(stiffness),
        size_(motion.mass().size()),
        tolerance_(motion.tolerance()),
        y_(2 * static_cast<long>(size_), context_),
        absolute_(2 * static_cast<long>(size_), context_),
        force_(size_),
        shifted_(size_),
        right_(size_) {}

  ImplicitEnd run();

 private:
  std::span<double> u_of(N_Vector y) const { return values_of(y).first(size_); }
  std::span<double> v_of(N_Vector y) const { return values_of(y).last(size_); }
  void create(double first_step);
  void watch_iterations();
  bool recover(const SolverCode& code);
  bool slower_than_explicit();

  int rate(double time, N_Vector y, N_Vector rate);
  int jacobian_times(N_Vector x, N_Vector product, double time, N_Vector y, N_Vector rate);
  int prepare(N_Vector y, bool stiffness_is_good, booleantype* renewed, double gamma);
  int precondition(N_Vector residual, N_Vector x);

  DampedMotion& motion_;
  StiffnessFactor& stiffness_;
  std::size_t size_;
  double tolerance_;
  SolverContext context_;
  SolverVector y_, absolute_;
  LinearSolver linear_;
  CvodeMemory cvode_;
  CallbackGuard guard_;
  std::vector<double> force_, shifted_, right_;
  double factored_gamma_ = 0.0;  // of the present factor; 0: none
  long stiffness_step_ = -1;     // motion step at which K was assembled
  bool stiffness_is_old_ = false;
  double wasted_ = 0.0;  // GMRES iterations lost to the age of the factor
  long newton_iterations_ = 0, linear_iterations_ = 0, iterations_before_ = 0;
  int restarts_ = 0;
  long restart_step_ = 0;
  double last_step_ = 0.0, reviewed_time_ = 0.0, explicit_step_ = 0.0;
  std::string message_;
};

ImplicitMotion& self(void* data) {
  return *static_cast<ImplicitMotion*>(data);
}

void require(int flag, const char* what) {
  if (flag != CV_SUCCESS)
    throw Stop(ExitCode::guard, fmt::format("relaxation: {} failed with {}", what, cvode_code(flag).name));
}

void ImplicitMotion::create(double first_step) {
  const auto rate_of = [](realtype time, N_Vector y, N_Vector dy, void* data) {
    return self(data).guard_.run([&] { return self(data).rate(time, y, dy); });
  };
  const auto times = [](N_Vector x, N_Vector product, realtype time, N_Vector y, N_Vector dy, void* data, N_Vector) {
    return self(data).guard_.run([&] { return self(data).jacobian_times(x, product, time, y, dy); });
  };
  const auto setup = [](realtype, N_Vector y, N_Vector, booleantype good, booleantype* renewed, realtype gamma,
                        void* data) {
    return self(data).guard_.run([&] { return self(data).prepare(y, good != 0, renewed, gamma); });
  };
  const auto solve = [](realtype, N_Vector, N_Vector, N_Vector residual, N_Vector x, realtype, realtype, int,
                        void* data) {
    return self(data).guard_.run([&] { return self(data).precondition(residual, x); });
  };
  std::ranges::copy(motion_.displacement(), u_of(y_).begin());
  std::ranges::copy(motion_.velocity(), v_of(y_).begin());
  // Velocities are resolved down to rtol times the largest displacement swinging at omega_1, displacements a hundred
  // times finer: that costs little and keeps the noise of long steps, displacement error over step, out of the kinetic
  // energy.
  const double length = tolerance_ * motion_.length_scale();
  std::ranges::fill(u_of(absolute_), 0.01 * length);
  std::ranges::fill(v_of(absolute_), length * 2.0 * std::numbers::pi / motion_.period());

  cvode_.reset(CVodeCreate(CV_BDF, context_));
  linear_.reset(SUNLinSol_SPGMR(y_, SUN_PREC_LEFT, krylov_dimension, context_));
  if (!cvode_ || !linear_) throw Stop(ExitCode::out_of_resources, "relaxation: no memory for CVODE");
  void* memory = cvode_.get();
  require(CVodeSetErrHandlerFn(memory, CallbackGuard::collect, &guard_), "CVodeSetErrHandlerFn");
  require(CVodeInit(memory, rate_of, motion_.time(), y_), "CVodeInit");
  require(CVodeSetUserData(memory, this), "CVodeSetUserData");
  require(CVodeSVtolerances(memory, tolerance_, absolute_), "CVodeSVtolerances");
  require(CVodeSetMaxOrd(memory, 2), "CVodeSetMaxOrd");
  require(CVodeSetInitStep(memory, first_step), "CVodeSetInitStep");
  require(CVodeSetMaxStep(memory, motion_.period() / 16.0),
          "CVodeSetMaxStep");  // so that a period is seen, not jumped over
  require(CVodeSetMaxNonlinIters(memory, 5), "CVodeSetMaxNonlinIters");
  require(CVodeSetMaxErrTestFails(memory, 15), "CVodeSetMaxErrTestFails");
  require(CVodeSetMaxConvFails(memory, 15), "CVodeSetMaxConvFails");
  require(CVodeSetLinearSolver(memory, linear_.get(), nullptr), "CVodeSetLinearSolver");
  require(CVodeSetPreconditioner(memory, setup, solve), "CVodeSetPreconditioner");
  require(CVodeSetJacTimes(memory, nullptr, times), "CVodeSetJacTimes");
  // K is renewed when it is found to be bad, not by the calendar.
  require(CVodeSetJacEvalFrequency(memory, 1000000), "CVodeSetJacEvalFrequency");
  newton_iterations_ = iterations_before_ = 0;
}

int ImplicitMotion::rate(double time, N_Vector y, N_Vector dy) {
  const std::span<const double> mass = motion_.mass();
  const std::span<double> v = v_of(y), du = u_of(dy), dv = v_of(dy);
  if (!motion_.force(u_of(y), time, force_)) return 1;
  for (std::size_t i = 0; i < size_; ++i) {
    du[i] = v[i];
    dv[i] = -force_[i] / mass[i] - motion_.alpha() * v[i];
  }
  return 0;
}

/// J (a, b) = (b, -M^-1 K(u) a - alpha b). The step of the difference is large enough for soft modes to rise above the
/// rounding of the stiff ones (1e-5 of the displacements), and small against anything the force is nonlinear over.
int ImplicitMotion::jacobian_times(N_Vector x, N_Vector product, double time, N_Vector y, N_Vector dy) {
  const std::span<const double> mass = motion_.mass();
  const std::span<double> u = u_of(y), v = v_of(y), dv = v_of(dy), a = u_of(x), b = v_of(x);
  const std::span<double> ja = u_of(product), jb = v_of(product);
  double largest = 0.0;
  for (const double value : a) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < size_; ++i) ja[i] = b[i], jb[i] = -motion_.alpha() * b[i];
  if (largest == 0.0) return 0;
  const double step = 1e-5 * motion_.length_scale() / largest;
  for (std::size_t i = 0; i < size_; ++i) shifted_[i] = u[i] + step * a[i];
  if (!motion_.force(shifted_, time, force_)) return 1;
  for (std::size_t i = 0; i < size_; ++i) jb[i] -= (force_[i] / mass[i] + dv[i] + motion_.alpha() * v[i]) / step;
  return 0;
}

int ImplicitMotion::prepare(N_Vector y, bool stiffness_is_good, booleantype* renewed, double gamma) {
  const double ratio =
      factored_gamma_ > 0.0 ? std::max(gamma / factored_gamma_, factored_gamma_ / gamma) : 2.0 * too_far;
  const bool too_slow = wasted_ > stiffness_.factorisation_in_solves();
  const bool fresh = stiffness_step_ == motion_.steps();
  const bool assemble = !fresh && (!stiffness_is_good || stiffness_is_old_ || (too_slow && ratio < near_enough));
  if (assemble) {
    stiffness_.replace(motion_.problem().stiffness(u_of(y)));
    stiffness_step_ = motion_.steps();
    stiffness_is_old_ = false;
  }
  // When CVODE complains although K is fresh, the factor gets the very gamma of this step.
  if (assemble || too_slow || ratio > too_far || (!stiffness_is_good && ratio != 1.0)) {
    stiffness_.factor(gamma * gamma, 1.0 + gamma * motion_.alpha());
    factored_gamma_ = gamma;
    wasted_ = 0.0;
  }
  *renewed = assemble || !stiffness_is_good ? SUNTRUE : SUNFALSE;
  return 0;
}

int ImplicitMotion::precondition(N_Vector residual, N_Vector x) {
  const std::span<const double> mass = motion_.mass();
  const std::span<double> ru = u_of(residual), rv = v_of(residual), xu = u_of(x), xv = v_of(x);
  const double gamma = factored_gamma_, damped = 1.0 + gamma * motion_.alpha();
  for (std::size_t i = 0; i < size_; ++i) right_[i] = mass[i] * (damped * ru[i] + gamma * rv[i]);
  stiffness_.solve(right_, shifted_);
  for (std::size_t i = 0; i < size_; ++i) {
    const double solution = shifted_[i];
    xv[i] = (solution - ru[i]) / gamma;
    xu[i] = solution;
  }
  return 0;
}

/// Counts the GMRES iterations that a factor for the present K and gamma would have saved: all but one a Newton
/// iteration.
void ImplicitMotion::watch_iterations() {
  long newton = 0, linear = 0;
  CVodeGetNumNonlinSolvIters(cvode_.get(), &newton);
  CVodeGetNumLinIters(cvode_.get(), &linear);
  const long linear_gained = linear - iterations_before_, newton_gained = newton - newton_iterations_;
  wasted_ += static_cast<double>(std::max(0L, linear_gained - newton_gained));
  linear_iterations_ += linear_gained;
  iterations_before_ = linear;
  newton_iterations_ = newton;
}

/// Acts on a failure; false if nothing is left to try.
bool ImplicitMotion::recover(const SolverCode& code) {
  const std::string notes = guard_.take_notes();
  message_ += fmt::format("{}CVODE at {:.4g} ms: {} ({}), {}", message_.empty() ? "" : "; ", motion_.time() * 1e3,
                          code.name, code.meaning, words_for(code.action));
  if (code.action == SolverAction::stop)
    throw Stop(ExitCode::guard, "relaxation: " + message_ + (notes.empty() ? "" : " [" + notes + "]"));
  if (code.action == SolverAction::fall_back) return false;
  restarts_ = motion_.steps() - restart_step_ > 20 ? 1 : restarts_ + 1;
  restart_step_ = motion_.steps();
  if (restarts_ > patience) {
    message_ += fmt::format("; gave up after {} restarts in a row", patience);
    return false;
  }
  if (code.action == SolverAction::raise_limits) {
    CVodeSetMaxNumSteps(cvode_.get(), 1000000);
    return true;
  }
  double shorter = 0.1;
  if (code.action == SolverAction::shorten) shorter = 1e-3;
  if (code.action == SolverAction::loosen) {
    double factor = 10.0;
    CVodeGetTolScaleFactor(cvode_.get(), &factor);
    tolerance_ *= std::max(2.0, factor);
  }
  if (code.action == SolverAction::refactor) stiffness_step_ = -1, stiffness_is_old_ = true, factored_gamma_ = 0.0;
  create(std::max(shorter * last_step_, 1e-9 * motion_.period()));
  return true;
}

/// Crawling along with steps an explicit integrator could take for a fraction of the price.
bool ImplicitMotion::slower_than_explicit() {
  if (motion_.steps() % review != 0) return false;
  const double average = (motion_.time() - std::exchange(reviewed_time_, motion_.time())) / review;
  if (average > motion_.period() / 100.0) return false;
  if (explicit_step_ == 0.0) explicit_step_ = stable_explicit_step(stiffness_);
  if (average > explicit_step_) return false;
  message_ += fmt::format("{}CVODE at {:.4g} ms: steps of {:.3g} us, shorter than the explicit {:.3g} us; gave up",
                          message_.empty() ? "" : "; ", motion_.time() * 1e3, average * 1e6, explicit_step_ * 1e6);
  return true;
}

ImplicitEnd ImplicitMotion::run() {
  stiffness_step_ = motion_.steps();  // K came with the present state
  reviewed_time_ = motion_.time();
  last_step_ = 1e-4 * motion_.period();
  create(last_step_);
  ImplicitEnd end;
  while (!motion_.finished()) {
    double time = motion_.time();
    const int flag = CVode(cvode_.get(), time + motion_.period(), y_, &time, CV_ONE_STEP);
    guard_.rethrow();
    const SolverCode& code = cvode_code(flag);
    if (code.action == SolverAction::proceed) {
      last_step_ = time - motion_.time();
      motion_.accept(time, u_of(y_), v_of(y_));
      watch_iterations();
      end.gave_up = slower_than_explicit();
      if (end.gave_up) break;
    } else if (!recover(code)) {
      end.gave_up = true;
      break;
    }
  }
  end.message = message_;
  end.linear_iterations = linear_iterations_;
  return end;
}

}  // namespace

ImplicitEnd run_implicit(DampedMotion& motion, StiffnessFactor& stiffness) {
  return ImplicitMotion(motion, stiffness).run();
}

}  // namespace standoff::structure
