// A texture at a point: wrap modes, nearest and linear, trilinear mip levels. Before it come TextureLook (wrap_s, wrap_t,
// mag, min, mip: kTexelNearest, kTexelLinear or kNoMips; levels), TextureLevel (width, height), and the accessors
//     TextureLevel levelAt(TextureLook look, int i);     dvec4 texelOf(TextureLevel level, int x, int y);

const int kWrapRepeat = 0;
const int kWrapMirrored = 1;
const int kWrapClamp = 2;
const int kTexelNearest = 0;
const int kTexelLinear = 1;
const int kNoMips = -1;

/// One period of the wrapped coordinate: [0, 1] repeated, [0, 2] mirrored, clamped a texel or more outside [0, 1].
EDGEWISE_EXACT_FN double reducedCoordinate(double u, int wrap) {
    if (wrap == kWrapRepeat) return u - floor(u);
    if (wrap == kWrapMirrored) return u - 2.0 * floor(0.5 * u);
    return clamped(u, -1.0, 2.0);
}

/// The texel that index i means, at most a period below 0.
EDGEWISE_FN int wrappedIndex(int i, int size, int wrap) {
    if (wrap == kWrapClamp) return i < 0 ? 0 : (i < size ? i : size - 1);
    int period = wrap == kWrapRepeat ? size : 2 * size;
    int j = (i + period) % period;
    return j < size ? j : period - 1 - j;
}

EDGEWISE_EXACT_FN dvec4 sampleLevel(TextureLook look, TextureLevel level, dvec2 uv, int filter_kind) {
    double x = reducedCoordinate(uv.x, look.wrap_s) * level.width;
    double y = reducedCoordinate(uv.y, look.wrap_t) * level.height;
    bool linear = filter_kind == kTexelLinear;
    double left = floor(linear ? x - 0.5 : x);
    double top = floor(linear ? y - 0.5 : y);
    int i = wrappedIndex(int(left), level.width, look.wrap_s);
    int j = wrappedIndex(int(top), level.height, look.wrap_t);
    if (!linear) return texelOf(level, i, j);
    double fx = (x - 0.5) - left;
    double fy = (y - 0.5) - top;
    int i1 = wrappedIndex(int(left) + 1, level.width, look.wrap_s);
    int j1 = wrappedIndex(int(top) + 1, level.height, look.wrap_t);
    dvec4 upper = texelOf(level, i, j) * (1.0 - fx) + texelOf(level, i1, j) * fx;
    dvec4 lower = texelOf(level, i, j1) * (1.0 - fx) + texelOf(level, i1, j1) * fx;
    return upper * (1.0 - fy) + lower * fy;
}

/// log2 x, x > 1, exact at powers of two. Error <= 3 * 2^-53 of max(1, the result).
EDGEWISE_EXACT_FN double log2Above1(double x) {
    double k = exponentOf(x * EDGEWISE_REAL(1.4142135623730951));
    return k + logReal(x * exp2Int(-k)) * EDGEWISE_REAL(1.4426950408889634);
}

/// log2 of the longer of the footprint's two sides in texels, 0 for at most a texel: OpenGL's rule.
EDGEWISE_EXACT_FN double mipLevel(dvec2 size, dvec2 duv_dx, dvec2 duv_dy) {
    double longer = larger(lengthOf(duv_dx * size), lengthOf(duv_dy * size));
    return longer > 1.0 ? log2Above1(smaller(longer, EDGEWISE_REAL(1e300))) : 0.0;
}

/// uv = (0, 0) is the image's upper left corner; at level 0 the mag filter holds, above it the min filter.
EDGEWISE_EXACT_FN dvec4 sampleLevels(TextureLook look, dvec2 uv, dvec2 duv_dx, dvec2 duv_dy) {
    TextureLevel whole = levelAt(look, 0);
    double level = mipLevel(dvec2(whole.width, whole.height), duv_dx, duv_dy);
    bool magnified = !(level > 0.0);
    int filter_kind = magnified ? look.mag : look.min;
    double bounded = magnified || look.mip == kNoMips ? 0.0 : smaller(level, double(look.levels - 1));
    double from = look.mip == kTexelNearest ? ceil(bounded - 0.5) : floor(bounded);
    double t = look.mip == kTexelNearest ? 0.0 : bounded - from;
    dvec4 finer = sampleLevel(look, levelAt(look, int(from)), uv, filter_kind);
    if (t == 0.0) return finer;
    return finer * (1.0 - t) + sampleLevel(look, levelAt(look, int(from) + 1), uv, filter_kind) * t;
}
