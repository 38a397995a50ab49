// GLSL only: the values of visibility as the shared text names them. C++ has them in analytic/.
#define EDGEWISE_OUT(type) out type

struct FineCoordinate { double grid; double rest; };
struct FinePoint { dvec2 grid; dvec2 rest; };
struct Cell { dvec2 min; dvec2 max; };
struct LineRef { uint i; uint j; };
struct Carrier { LineRef ref; dvec2 a; dvec2 b; dd A; dd B; dd C; dvec2 anchor; };
struct ScreenTriangle { dvec2 p_px[3]; uint vertex[3]; uint owner; uint plane; };
struct DepthPlane { double dz_dx; double dz_dy; double z_anchor; };
struct LocalPlane { double a; double b; double c; double error; uint plane; uint owner; };
/// Units of 2^-76 px above the frame's origin: hi 2^44 + lo, 0 <= lo < 2^44, both whole numbers.
struct OrderKey { double hi; double lo; };
struct CellFrame { Cell cell; dvec2 origin; OrderKey top; OrderKey bottom; };
struct LeafLine {
    Carrier carrier;
    OrderKey y0; OrderKey y1; OrderKey in0; OrderKey in1;
    int side_before; int side_after;
    FinePoint enter; FinePoint exit;
    double slope; double x_low; double x_high;
};
struct LeafHorizontal { Carrier carrier; OrderKey key; FineCoordinate y; FinePoint low; FinePoint high; };

const uint kBackground = 0xffffffffu;
const uint kFirstEdge = 0xfffffff0u;

bool isEdge(Carrier line) { return line.ref.j >= kFirstEdge; }
bool isHorizontal(Carrier line) { return isEdge(line) ? line.a.y == line.b.y : line.A.hi == 0.0lf; }
bool refBefore(LineRef p, LineRef q) { return p.i < q.i || (p.i == q.i && p.j < q.j); }

double nearestEven(double x) { return roundEven(x); }

OrderKey keyOf(double steps, double rest) {
    bool negative = rest < 0.0lf;
    return OrderKey(negative ? steps - 1.0lf : steps, negative ? rest + 17592186044416.0lf : rest);
}
bool keyLess(OrderKey p, OrderKey q) { return p.hi < q.hi || (p.hi == q.hi && p.lo < q.lo); }
bool keyEqual(OrderKey p, OrderKey q) { return p.hi == q.hi && p.lo == q.lo; }
OrderKey farKey(double sign) { return OrderKey(sign * 1e30lf, 0.0lf); }

/// cross(u, v) of grid vectors, |u|, |v| < 2^22 px: multiples of 2^-64 px^2 below 2^45, so that what is left
/// beside the leading part is one double.
dd crossValue(dvec2 u, dvec2 v) {
    dd p = twoProd(u.x, v.y);
    dd q = twoProd(u.y, v.x);
    dd s = twoSum(p.hi, -q.hi);
    dd t = twoSum(p.lo, -q.lo);
    dd m = twoSum(s.lo, t.hi);
    dd top = twoSum(s.hi, m.hi);
    return quickTwoSum(top.hi, top.lo + (m.lo + t.lo));
}
double crossSign(dvec2 u, dvec2 v) { return crossValue(u, v).hi; }
