// GLSL only: a segment and its line, as analytic/lane_kernel.h has them in C++.
struct EdgeInput {
    double a_x, a_y, a_rest_x, a_rest_y, b_x, b_y, b_rest_x, b_rest_y, len;
    double origin_x, origin_y, nx_hi, nx_lo, ny_hi, ny_lo, c_hi, c_lo, line_length, direction_x, direction_y;
};
#define SeenEdge EdgeInput
