// The first frame of a renderer: what is done before it, and what the render thread is spared.
#include <fstream>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

/// Calls of the calling thread that read files, as Linux counts them.
uint64_t CountReads()
{
	std::ifstream File("/proc/thread-self/io");
	std::string Name;
	uint64_t Value = 0;
	while (File >> Name >> Value)
	{
		if (Name == "syscr:") { return Value; }
	}
	ADD_FAILURE() << "Linux counts no reads";
	return 0;
}

class FModuleFirstFrameTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		bPrecache = false;
		ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
		SetSoftSun();
		const float Sky[] = {0.4f, 0.6f, 1.0f};
		ASSERT_OK(Renderer->SetSky(Sky));
	}
	FRTModuleFrame DescribeWhole()
	{
		FRTModuleFrame Frame = DescribeFrame();
		for (const FSignalInfo& Info : SignalInfos) { Frame.Wanted.Add(Info.Signal); }
		return Frame;
	}
};

// Shaders, what the process looks like to the library of tasks, and the number of cores are all files.
TEST_F(FModuleFirstFrameTest, TheFirstFrameReadsNoFile)
{
	const FRTModuleFrame Frame = DescribeWhole();
	const uint64_t Start = CountReads();
	const uint64_t OfCounting = CountReads() - Start;
	const uint64_t Before = CountReads();
	const FRTStatus Status = Renderer->RenderFrame(Frame, &Outputs);
	EXPECT_EQ(CountReads() - Before - OfCounting, 0u);
	ASSERT_OK(Status);
	EXPECT_FALSE(Outputs.bShadersReady) << "the first frame asked for shaders";
	ASSERT_OK(Renderer->EndFrame(nullptr));
}

} // namespace
} // namespace Lantern
