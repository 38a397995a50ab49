#include <analytic/double_double.h>
#include <pipeline/version.h>
#include <pipeline/write_image.h>

#include <string_view>

int main() {
    const auto sum = edgewise::f64::twoSum(1.0, 0x1p-60);
    const bool png = edgewise::imageFormat("picture.png") == edgewise::ImageFormat::kPng;
    return sum.lo == 0x1p-60 && png && edgewise::version() == std::string_view("0.1.0") ? 0 : 1;
}
