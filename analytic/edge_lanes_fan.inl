// Fan terms of radial kernels, inside the support's disk, and crossings with its circle. [E3]-[E9], [E12]

/// The part of the segment inside the disk: [t1, t2], `length` px long.
struct Piece {
    real t1, t2, length;
};

/// mean over one piece of phi1(r^2 / 2 sigma^2), by `rule`; positions in units of sqrt 2 sigma.
EDGEWISE_FN real phi1Mean(const RuleView& rule, real h, real t, real step) {
    const int count = rule.count;
    real sum = splat(0.0);
    for (int i = 0; i < count; ++i) {
        const real at = t + step * rule.node[i];
        sum = sum + rule.weight[i] * phi1(h * h + at * at);
    }
    return sum;
}

/// Mean of phi1 over the piece: equal parts of at most 3 sigma, each with the smallest rule that is proven for it.
/// Nodes are counted from the end nearer to the foot point: from the other they would lose their digits near the
/// sample, where phi1 is large. [E9]
EDGEWISE_FN real gaussianMean(const LaneKernel& kernel, real h, Piece piece) {
    const real sigmas = piece.length / kernel.sigma;
    const real wanted = nearestInteger(sigmas * (1.0 / kLongestPieceSigmas) + 0.5);  // ceil, or one more
    const real parts = wanted < 1.0 ? splat(1.0) : wanted;
    const real part = sigmas / parts;
    const real start = absolute(piece.t1) <= absolute(piece.t2) ? piece.t1 : -piece.t2;  // phi1 is even in t
    const real hs = h * kernel.inverse_reach, ts = start * kernel.inverse_reach;
    const real step = piece.length * kernel.inverse_reach / parts;
    real mean = splat(0.0);
    double lower = -1.0;
    for (int r = 0; r < kPieceRules; ++r) {
        const double upper = r == kPieceRules - 1 ? 1e300 : kernel.piece_rules[r].limit_sigma;
        const mask mine = (part > lower) & (part <= upper);
        lower = upper;
        if (!any(mine)) continue;
        real sum = splat(0.0);
        for (double i = 0.0; any((i < parts) & mine); i += 1.0) {
            const real here = phi1Mean(kernel.piece_rules[r].rule, hs, ts + step * i, step);
            sum = sum + (i < parts ? here : splat(0.0));
        }
        mean = mine ? sum / parts : mean;
    }
    return mean;
}

/// g of an even polynomial, in powers of (r/R)^2: exact nodes. [E8]
EDGEWISE_FN real polyMean(const LaneKernel& kernel, real h, Piece piece) {
    const int nodes = kernel.poly_rule.count;
    const double* c = kernel.poly;
    const real hs = h / kernel.radius, ts = piece.t1 / kernel.radius, step = piece.length / kernel.radius;
    real mean = splat(0.0);
    for (int i = 0; i < nodes; ++i) {
        const real at = ts + step * kernel.poly_rule.node[i];
        const real q = hs * hs + at * at;
        real g = splat(c[nodes - 1]);
        for (int k = nodes - 2; k >= 0; --k) g = g * q + c[k];
        mean = mean + kernel.poly_rule.weight[i] * g;
    }
    return mean;
}

/// The Gaussian's disk beyond inner_radius, where g is 1/(2 pi r^2): angles, and the piece that is left inside. The
/// parts' lengths add up to those of a short piece, which may be far better known than its ends: on the circle both
/// forms of g agree, so that a cut may err along the line, but no length may be lost: the ends are known to roundings
/// of the radius, however short the chord is. Of a piece longer than the radius the ends of the inside part are known
/// better than its length. [E9]
EDGEWISE_FN real takeOuterAngles(const LaneKernel& kernel, real h, Piece& piece) {
    const real c = halfChord(h, splat(kernel.inner_radius)), none = splat(0.0);
    const mask whole = (piece.t2 <= -c) | (c <= 0.0);
    real before = smaller(larger(-c - piece.t1, none), piece.length);
    before = whole ? piece.length : before;
    real after = smaller(larger(piece.t2 - c, none), piece.length - before);
    after = piece.t1 >= c ? piece.length - before : after;
    const real before_end = whole ? piece.t2 : -c, after_start = larger(piece.t1, c);
    real angle = before > 0.0 ? subtendedAngle(h, piece.t1, before_end, before) : none;
    angle = angle + (after > 0.0 ? subtendedAngle(h, after_start, piece.t2, after) : none);
    const mask is_long = (piece.length > kernel.inner_radius) & (before + after > 0.0);
    piece.t1 = larger(piece.t1, -c);
    piece.t2 = smaller(piece.t2, c);
    piece.length = is_long ? larger(piece.t2 - piece.t1, none) : (piece.length - before) - after;
    return angle * 0.15915494309189535;
}

EDGEWISE_FN real fanTerm(const LaneKernel& kernel, real h, Piece piece) {
    real outer = splat(0.0);
    if (kernel.inner_radius < kernel.radius) outer = takeOuterAngles(kernel, h, piece);
    const real cross = h * piece.length;
    switch (kernel.form) {
        case TermForm::kDisk: return cross * kernel.scale;
        case TermForm::kCone:
            return cross * coneMean(h, piece.t1, piece.t2, piece.length, splat(kernel.radius)) * kernel.scale;
        case TermForm::kGaussian: return outer + cross * gaussianMean(kernel, h, piece) * kernel.scale;
        default: return cross * polyMean(kernel, h, piece) * kernel.scale;
    }
}

/// Where the line at t meets the circle: its angle in turns, and how far rounding may have moved it.
EDGEWISE_FN void circleCrossing(const LaneKernel& kernel, const Line& line, real t, real in_a, real in_b, mask crossed,
                                int slot, int first, EdgeTerms& terms) {
    terms.crossed[slot] |= laneSet(crossed, first);
    if (!any(crossed)) return;
    const real turns = atan2Real(t * line.d_y - line.h * line.d_x, line.h * line.d_y + t * line.d_x) * 0.15915494309189535;
    store(toFixed(turns), first, terms.position[slot]);
    store(turns, first, terms.order[slot]);
    const real steep = line.h / nonZero(absolute(t));  // t = -0 is an entry still
    const real slope = slot == 0 ? -steep : steep;
    store(spreadFrom(line, t, slope, in_a, in_b), first, terms.spread[slot]);
    // h errs by 4u R, so the half chord c by 4u R^2/c, or sqrt(8u) R when the line is that near to a tangent
    const real amplified = smaller(kernel.radius / larger(absolute(t), splat(0x1p-1000)), splat(0x1p27));
    store((1.0 + amplified) * 0x1p-51, first, terms.doubt[slot]);
}

/// The segment against the support's disk: which ends are inside (0 or 1), where it enters and leaves, what is inside.
struct DiskCut {
    real in_a, in_b, through, entry, exit;
    mask touched;
    Piece piece;
};

EDGEWISE_FN DiskCut cutByDisk(const LaneKernel& kernel, const Line& line) {
    const double R2 = kernel.radius * kernel.radius;
    const real one = splat(1.0), none = splat(0.0);
    const real c = halfChord(line.h, splat(kernel.radius));
    DiskCut cut;
    cut.in_a = line.a_x * line.a_x + line.a_y * line.a_y <= R2 ? one : none;
    cut.in_b = line.b_x * line.b_x + line.b_y * line.b_y <= R2 ? one : none;
    const real chord = (line.t_a < 0.0 ? one : none) * (line.t_b > 0.0 ? one : none) * (c > 0.0 ? one : none);
    cut.through = chord * (1.0 - cut.in_a) * (1.0 - cut.in_b);
    cut.touched = cut.in_a + cut.in_b + cut.through > 0.5;
    // A short piece may count as leaving where its line enters, and an end may lie past the rounded chord: the
    // crossing is on the segment all the same. [E4]
    cut.entry = larger(smaller(-c, line.t_b), line.t_a), cut.exit = smaller(larger(c, line.t_a), line.t_b);
    cut.piece.t1 = cut.in_a > 0.5 ? line.t_a : cut.entry;
    cut.piece.t2 = cut.in_b > 0.5 ? line.t_b : cut.exit;
    cut.piece.length = cut.in_a + cut.in_b > 1.5 ? line.length : larger(cut.piece.t2 - cut.piece.t1, none);
    cut.piece.length = cut.touched ? cut.piece.length : none;
    return cut;
}

/// Returns the inside parts before they are rounded to fixed point.
EDGEWISE_FN real fanTerms(const LaneKernel& kernel, const Line& line, int first, EdgeTerms& terms) {
    const DiskCut cut = cutByDisk(kernel, line);
    const real none = splat(0.0);
    terms.touched |= laneSet(cut.touched, first);
    if (!any(cut.touched)) {
        store(toFixed(none), first, terms.value);
        return none;
    }
    const real term = flushTiny(fanTerm(kernel, line.h, cut.piece));
    const real value = cut.touched ? term : none;
    store(toFixed(value), first, terms.value);
    circleCrossing(kernel, line, cut.entry, cut.in_a, cut.in_b, (1.0 - cut.in_a) * (cut.in_b + cut.through) > 0.5, 0,
                   first, terms);
    circleCrossing(kernel, line, cut.exit, cut.in_a, cut.in_b, (1.0 - cut.in_b) * (cut.in_a + cut.through) > 0.5, 1,
                   first, terms);
    return value;
}
