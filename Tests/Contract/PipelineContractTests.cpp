// Creation and release of pipelines.
#include "ContractShaders.h"

namespace Lantern
{
namespace
{

CONTRACT_TEST(PipelinesOfAllKinds)
{
	const auto Compute = MakeComputePipeline(Device(), "WriteWords.comp");
	ASSERT_TRUE(Compute);
	EXPECT_EQ(Compute->GetGroupCount(), 0u);
	for (const ERTFormat Format : {ERTFormat::RGBA8_UNORM, ERTFormat::RGBA16_FLOAT, ERTFormat::Unknown})
	{
		const auto Raster = MakeRasterPipeline(Device(), Format, ERTFormat::D32_FLOAT, ERTCull::Back);
		ASSERT_TRUE(Raster);
		EXPECT_EQ(Raster->GetGroupCount(), 0u);
	}
	if (!Caps().bRayTracingPipeline) { GTEST_SKIP() << "the device has no ray-tracing pipelines"; }
	const auto Rays = MakeRayPipeline(Device());
	ASSERT_TRUE(Rays);
	EXPECT_EQ(Rays->GetGroupCount(), 9u);
}

CONTRACT_TEST(PipelineMayGoBeforeItsList)
{
	auto Pipeline = MakeComputePipeline(Device(), "WriteWords.comp");
	const auto Output = Make.Buffer(32, ERTMemory::Readback);
	const auto List = Make.List();
	List->SetPipeline(Pipeline.Get());
	FContractPush Push;
	Push.Output = Output->GetDeviceAddress();
	Push.C = 8;
	List->PushConstants(&Push, sizeof(Push));
	List->Dispatch(1, 1, 1);
	Pipeline.Reset();
	Device().CollectGarbage();
	Run(List.Get());
}

} // namespace
} // namespace Lantern
