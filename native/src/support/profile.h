// Where the processor time of a call goes: code marks what phase it belongs to, each thread keeps its own account.
#pragma once

#include <array>

namespace atlas_refine {

/// Kinds of work, whatever stage asks for them.
enum class Phase {
  Input,        ///< charts from faces
  Pack,         ///< charts placed by their outlines
  Align,        ///< charts deformed to the axes
  Layout,       ///< rectangles
  Coarsen,      ///< coarse charts, and back to the fine ones
  Assemble,     ///< gradients and Hessians
  Order,        ///< of elimination, and what the factor will look like
  Factor,       ///< Cholesky factors
  Solve,        ///< with them
  Contacts,     ///< pairs that are near each other, found
  LineSearch,   ///< first flips and collisions, backtracking
  Certificate,  ///< exact tests and measures
  Other,
};
inline constexpr int kPhases = static_cast<int>(Phase::Other) + 1;
/// Stable lower-case name ("line_search", ...), used in reports and in Python.
const char* to_string(Phase phase);

/// What one thread, or several together, have done.
struct Account {
  std::array<double, kPhases> seconds = {};  ///< of processor time
  int steps = 0;                             ///< Newton steps under contact
  double fractions = 0;                      ///< the parts of them that were taken, summed up

  Account& operator+=(const Account& other);
};

/// What this thread does while it lives belongs to a phase, but for what scopes inside it claim. Costs two readings of the
/// thread's clock: not for single triangles.
class PhaseScope {
 public:
  explicit PhaseScope(Phase phase);
  ~PhaseScope();
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  Phase outer_;
};

Phase present_phase();
/// The part of a Newton step under contact that was taken.
void account_step(double fraction);
/// What other threads have done for this one.
void account_for(const Account& others);
/// The account of this thread since this was last called, or since its first scope.
Account take_account();

}  // namespace atlas_refine
