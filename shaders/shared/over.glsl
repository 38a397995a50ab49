// "Over": pipeline/composite.h has the equation.

/// Layers front to back: what is left for those behind one of this alpha; the last has all that is left.
EDGEWISE_EXACT_FN double shareOf(double left, double alpha, bool last) { return last ? left : left * alpha; }
EDGEWISE_EXACT_FN double leftBehind(double left, double alpha, bool last) { return last ? 0.0 : left * (1.0 - alpha); }
