// Samplers of the module's materials: which indices a material can name.
#include <algorithm>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

// Sampler indices have ten bits in a material. More may be alive on a device whose heap is larger.
class FModuleSamplerTest : public FModuleTest
{
protected:
	void SetUp() override { Open({.MaxSamplers = 2000}); }
};

TEST_F(FModuleSamplerTest, SamplersThatMaterialsCannotNameAreRefused)
{
	std::vector<TRTRef<IRTSampler>> Samplers(1100);
	for (TRTRef<IRTSampler>& Sampler : Samplers) { ASSERT_OK(Device->CreateSampler({}, Sampler.ReleaseAndGetAddress())); }
	FTexturedMaterial Tree = MakeTexturedMaterial("Bark");
	ERTMaterialHandle Handle = ERTMaterialHandle::None;
	const auto UseSampler = [&](uint32_t Index) {
		const auto Is = [=](const TRTRef<IRTSampler>& Sampler) { return Sampler->GetIndex() == Index; };
		const auto Found = std::find_if(Samplers.begin(), Samplers.end(), Is);
		Tree.Material.BaseColorMap.Sampler = Found != Samplers.end() ? Found->Get() : nullptr;
		return Renderer->AddMaterial(Tree.Material, &Handle);
	};
	EXPECT_TRUE(UseSampler(300).IsOk()) << "beyond eight bits";
	EXPECT_REFUSED(UseSampler(1050), "BaseColorMap");
	EXPECT_EQ(Handle, ERTMaterialHandle::None);
}

} // namespace
} // namespace Lantern
