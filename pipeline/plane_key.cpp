#include "pipeline/plane_key.h"

#include <bit>

namespace edgewise {
namespace {

/// Residues modulo 2^61 - 1, a Mersenne prime: a multiplication by 2^k is a rotation of 61 bits.
constexpr int kBits = 61;
constexpr std::uint64_t kPrime = (std::uint64_t(1) << kBits) - 1;

std::uint64_t addMod(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t sum = a + b;
    return sum >= kPrime ? sum - kPrime : sum;
}

std::uint64_t subMod(std::uint64_t a, std::uint64_t b) {
    return a >= b ? a - b : a + kPrime - b;
}

std::uint64_t mulMod(std::uint64_t a, std::uint64_t b) {
    __extension__ using Wide = unsigned __int128;
    const Wide product = Wide(a) * b;
    return addMod(std::uint64_t(product) & kPrime, std::uint64_t(product >> kBits));
}

/// a^(p - 2) = 1/a (Fermat).
std::uint64_t inverse(std::uint64_t a) {
    std::uint64_t result = 1;
    for (std::uint64_t exponent = kPrime - 2; exponent != 0; exponent >>= 1) {
        if (exponent & 1) result = mulMod(result, a);
        a = mulMod(a, a);
    }
    return result;
}

std::uint64_t residue(float value) {
    // The value is +-magnitude 2^(exponent - 150), by the fields of IEEE 754's binary32.
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t field = bits >> 23 & 0xffu, fraction = bits & 0x7fffffu;
    const std::uint64_t magnitude = field == 0 ? fraction : fraction | 0x800000u;
    const int exponent = field == 0 ? 1 : static_cast<int>(field);
    const int turn = (exponent - 150 + 3 * kBits) % kBits;
    const std::uint64_t turned = ((magnitude << turn) & kPrime) | (turn ? magnitude >> (kBits - turn) : 0);
    return (bits >> 31) != 0 && turned != 0 ? kPrime - turned : turned;
}

using Vector = std::array<std::uint64_t, 3>;

Vector residues(const glm::vec3& p) {
    return {residue(p.x), residue(p.y), residue(p.z)};
}

Vector difference(const Vector& a, const Vector& b) {
    return {subMod(a[0], b[0]), subMod(a[1], b[1]), subMod(a[2], b[2])};
}

Vector cross(const Vector& a, const Vector& b) {
    auto minor = [&](int i, int j) { return subMod(mulMod(a[i], b[j]), mulMod(a[j], b[i])); };
    return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 29);
}

/// n . p = d, up to a common factor.
struct Coefficients {
    Vector n;
    std::uint64_t d;

    /// The first component of n that is not 0; 3: none.
    int pivot() const { return n[0] != 0 ? 0 : (n[1] != 0 ? 1 : (n[2] != 0 ? 2 : 3)); }
};

Coefficients coefficients(const std::array<glm::vec3, 3>& triangle) {
    const Vector a = residues(triangle[0]);
    const Vector n = cross(difference(residues(triangle[1]), a), difference(residues(triangle[2]), a));
    return {n, addMod(addMod(mulMod(n[0], a[0]), mulMod(n[1], a[1])), mulMod(n[2], a[2]))};
}

std::uint64_t keyOf(const Coefficients& plane, std::uint64_t inverse_pivot) {
    std::uint64_t key = mix(0, static_cast<std::uint64_t>(plane.pivot()));
    for (const std::uint64_t c : {plane.n[1], plane.n[2], plane.d}) key = mix(key, mulMod(c, inverse_pivot));
    return key;
}

}  // namespace

/// One inversion for all (Montgomery): the inverse of the pivots' product, unwound from the back.
std::vector<std::optional<std::uint64_t>> planeKeys(std::span<const std::array<glm::vec3, 3>> triangles) {
    std::vector<Coefficients> planes;
    std::vector<std::uint64_t> product_before;
    planes.reserve(triangles.size()), product_before.reserve(triangles.size());
    std::uint64_t product = 1;
    for (const auto& triangle : triangles) {
        planes.push_back(coefficients(triangle));
        product_before.push_back(product);
        if (planes.back().pivot() < 3) product = mulMod(product, planes.back().n[planes.back().pivot()]);
    }
    std::vector<std::optional<std::uint64_t>> keys(triangles.size());
    std::uint64_t rest = inverse(product);
    for (std::size_t i = triangles.size(); i-- > 0;) {
        const int pivot = planes[i].pivot();
        if (pivot == 3) continue;
        keys[i] = keyOf(planes[i], mulMod(rest, product_before[i]));
        rest = mulMod(rest, planes[i].n[pivot]);
    }
    return keys;
}

}  // namespace edgewise
