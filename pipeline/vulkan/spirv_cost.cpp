#include "pipeline/vulkan/spirv_cost.h"

#include <glslang/SPIRV/spirv.hpp>
#include <unordered_map>
#include <vector>

namespace edgewise::vulkan {
namespace {

struct Function {
    double instructions = 0.0, words = 0.0;
    std::vector<std::uint32_t> calls;
    bool counted = false;
};

class Module {
  public:
    explicit Module(std::span<const std::uint32_t> words) {
        constexpr std::size_t kHeader = 5;
        for (std::size_t at = kHeader; at < words.size();) {
            const std::size_t count = words[at] >> 16u;
            if (count == 0 || at + count > words.size()) break;
            read(static_cast<spv::Op>(words[at] & 0xffffu), words.subspan(at + 1, count - 1));
            at += count;
        }
    }

    SpirvCost cost() {
        SpirvCost cost;
        cost.variable_words = private_words_;
        double largest = 0.0;
        // A function may be defined after its callers, so each is finished with a stack of its own.
        for (const std::uint32_t id : order_) {
            finish(id);
            cost.instructions += functions_[id].instructions;
            largest = std::max(largest, functions_[id].words);
        }
        cost.variable_words += largest;
        return cost;
    }

  private:
    void read(spv::Op op, std::span<const std::uint32_t> operands) {
        if (function_ != 0) ++functions_[function_].instructions;
        switch (op) {
            case spv::OpTypeFloat:
            case spv::OpTypeInt:
                size_[operands[0]] = operands[1] / 32.0;
                break;
            case spv::OpTypeBool:
                size_[operands[0]] = 1.0;
                break;
            case spv::OpTypeVector:
            case spv::OpTypeMatrix:
                size_[operands[0]] = size_[operands[1]] * operands[2];
                break;
            case spv::OpTypeArray:
                size_[operands[0]] = size_[operands[1]] * constant_[operands[2]];
                break;
            case spv::OpTypeStruct: {
                double sum = 0.0;
                for (const std::uint32_t member : operands.subspan(1)) sum += size_[member];
                size_[operands[0]] = sum;
                break;
            }
            case spv::OpTypePointer:
                size_[operands[0]] = size_[operands[2]];
                break;
            case spv::OpConstant:
                constant_[operands[1]] = operands[2];
                break;
            case spv::OpVariable:
                readVariable(static_cast<spv::StorageClass>(operands[2]), size_[operands[0]]);
                break;
            case spv::OpFunction:
                function_ = operands[1];
                order_.push_back(function_);
                break;
            case spv::OpFunctionCall:
                functions_[function_].calls.push_back(operands[2]);
                break;
            case spv::OpFunctionEnd:
                function_ = 0;
                break;
            default:
                break;
        }
    }
    void readVariable(spv::StorageClass storage, double words) {
        if (storage == spv::StorageClassFunction) functions_[function_].words += words;
        if (storage == spv::StorageClassPrivate) private_words_ += words;
    }

    void finish(std::uint32_t root) {
        std::vector<std::uint32_t> open{root};
        while (!open.empty()) {
            Function& function = functions_[open.back()];
            const std::size_t before = open.size();
            for (const std::uint32_t callee : function.calls)
                if (!functions_[callee].counted) open.push_back(callee);
            if (open.size() > before) continue;
            open.pop_back();
            if (function.counted) continue;
            for (const std::uint32_t callee : function.calls) {
                function.instructions += functions_[callee].instructions;
                function.words += functions_[callee].words;
            }
            function.counted = true;
        }
    }

    std::unordered_map<std::uint32_t, double> size_, constant_;
    std::unordered_map<std::uint32_t, Function> functions_;
    std::vector<std::uint32_t> order_;
    double private_words_ = 0.0;
    std::uint32_t function_ = 0;
};

}  // namespace

SpirvCost spirvCost(std::span<const std::uint32_t> words) {
    return Module(words).cost();
}

}  // namespace edgewise::vulkan
