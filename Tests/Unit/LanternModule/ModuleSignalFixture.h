// An engine's frames with all inputs, on the mock, and their outputs.
#pragma once

#include "ModuleTestTools.h"

namespace Lantern
{

class FModuleSignalTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
		ASSERT_OK(SetSun(-1.0));
		Motion = MakeTexture(ERTFormat::RGBA32_FLOAT, 64);
		BaseColor = MakeTexture(ERTFormat::RGBA8_SRGB, 64);
		Material = MakeTexture(ERTFormat::RGBA8_UNORM, 64);
	}
	void TearDown() override
	{
		for (TRTRef<IRTTexture>* Texture : {&Motion, &BaseColor, &Material}) { Texture->Reset(); }
		FModuleTest::TearDown();
	}
	FRTModuleFrame DescribeAll()
	{
		FRTModuleFrame Frame = DescribeFrame();
		Frame.Motion = Motion.Get();
		Frame.BaseColor = BaseColor.Get();
		Frame.Material = Material.Get();
		Frame.Wanted = {ESignal::SunShadow, ESignal::AmbientOcclusion, ESignal::DiffuseGI, ESignal::Reflections};
		return Frame;
	}
	/// Calls are those of this frame.
	void RenderAndEnd(const FRTModuleFrame& Frame)
	{
		Precache(Frame);
		Mock().ClearCalls();
		ASSERT_OK(Renderer->RenderFrame(Frame, &Outputs));
		ASSERT_OK(Renderer->EndFrame(nullptr));
	}
	/// Frames until all that Frame asks for is there.
	void RenderUntilComplete(FRTModuleFrame Frame)
	{
		Outputs = {};
		const auto Step = [&] {
			Frame.Commands = DescribeFrame().Commands;
			RenderAndEnd(Frame);
			GiveWay();
		};
		ASSERT_TRUE(WaitUntil(
		    "a complete frame", [&] { return Outputs.bComplete; }, Step));
	}
	std::vector<std::string> GetPasses()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::BeginMarker)) { Names.push_back(Call.Name); }
		return Names;
	}

	TRTRef<IRTTexture> Motion, BaseColor, Material;
};

} // namespace Lantern
