// What the module does with bad input: an error that names the argument, and nothing has changed.
#include <atomic>
#include <limits>
#include <mutex>
#include <thread>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleArgumentTest : public FModuleTest
{
protected:
	void TearDown() override
	{
		Other.Reset();
		FModuleTest::TearDown();
	}
	TRTRef<IRTModuleRenderer> Other;
};

TEST_F(FModuleArgumentTest, NullPointersOfTheModuleAreNamed)
{
	EXPECT_EQ(LanternCreateModule(ModuleVersion, nullptr), static_cast<int32_t>(ERTResult::InvalidArgument));
	EXPECT_REFUSED(Module->CreateDevice(false, nullptr), "CreateDevice: Out is null");
	EXPECT_REFUSED(Module->CreateRenderer(Device.Get(), {}, nullptr), "CreateRenderer: Out is null");
	EXPECT_REFUSED(Module->CreateRenderer(nullptr, {}, Other.ReleaseAndGetAddress()), "CreateRenderer: Device is null");
	EXPECT_REFUSED(Module->SetConsoleVariable(nullptr, "1"), "SetConsoleVariable: Name is null");
	EXPECT_REFUSED(Module->SetConsoleVariable("r.RT.Shadow", nullptr), "SetConsoleVariable: Value is null");
	char Text[8] = "kept";
	EXPECT_REFUSED(Module->GetConsoleVariable(nullptr, Text, sizeof(Text)), "GetConsoleVariable: Name is null");
	EXPECT_REFUSED(Module->GetConsoleVariable("r.RT.Shadow", nullptr, 8), "GetConsoleVariable: Out is null");
	EXPECT_REFUSED(Module->GetConsoleVariable("r.RT.Shadow", Text, 0), "GetConsoleVariable: Capacity is 0");
	EXPECT_STREQ(Text, "kept");
}

TEST_F(FModuleArgumentTest, InitializeIsCalledOnceButMayBeRepeatedAfterAnError)
{
	FRTModuleDesc Desc;
	Desc.ShaderFolder = LANTERN_SOURCE_DIR "/Shaders";
	EXPECT_REFUSED(Module->Initialize(Desc), "Initialize was called before");
	Renderer.Reset();
	Module.Reset();
	ASSERT_EQ(LanternCreateModule(ModuleVersion, Module.ReleaseAndGetAddress()), 0);
	EXPECT_REFUSED(Module->Initialize({}), "FRTModuleDesc::ShaderFolder is null");
	Desc.ConfigFolder = "/nowhere";
	EXPECT_EQ(Module->Initialize(Desc).Code, ERTResult::IoError);
	EXPECT_REFUSED(Module->CreateRenderer(Device.Get(), {}, Renderer.ReleaseAndGetAddress()), "Initialize was not called");
	Desc.ConfigFolder = nullptr;
	ASSERT_OK(Module->Initialize(Desc));
	ASSERT_OK(Module->CreateRenderer(Device.Get(), {}, Renderer.ReleaseAndGetAddress()));
}

TEST_F(FModuleArgumentTest, NullPointersOfTheRendererAreNamed)
{
	EXPECT_REFUSED(Renderer->AddMaterial({}, nullptr), "AddMaterial: Out is null");
	EXPECT_REFUSED(Renderer->AddMesh(DescribeTriangle(), nullptr), "AddMesh: Out is null");
	FRTModuleObject Added;
	Added.Mesh = AddMesh(DescribeTriangle());
	Added.Materials = &Solid;
	Added.MaterialCount = 1;
	EXPECT_REFUSED(Renderer->AddObject(Added, nullptr), "AddObject: Out is null");
	EXPECT_REFUSED(Renderer->RenderFrame(DescribeFrame(), nullptr), "RenderFrame: Out is null");
	EXPECT_REFUSED(Renderer->EndFrame(nullptr), "RenderFrame recorded nothing"); // the refused frame was none
	ASSERT_OK(RenderWholeFrame());
}

TEST_F(FModuleArgumentTest, HandlesOfAnotherRendererAreRefused)
{
	ASSERT_OK(Module->CreateRenderer(Device.Get(), {}, Other.ReleaseAndGetAddress()));
	// In each slot of Other there is something, so that slot and use alone would find it.
	ERTMaterialHandle Theirs = ERTMaterialHandle::None;
	for (int Count = 0; Count < 2; ++Count) { ASSERT_OK(Other->AddMaterial({}, &Theirs)); }
	ERTMeshHandle TheirMesh = ERTMeshHandle::None;
	FRTModuleMesh Cloth = DescribeTriangle();
	Cloth.bDeformable = true;
	ASSERT_OK(Other->AddMesh(Cloth, &TheirMesh));
	FRTModuleObject Desc;
	Desc.Mesh = TheirMesh;
	Desc.Materials = &Theirs;
	Desc.MaterialCount = 1;
	ERTObjectHandle TheirObject = ERTObjectHandle::None;
	ASSERT_OK(Other->AddObject(Desc, &TheirObject));

	const ERTMeshHandle Mesh = AddDeformableMesh();
	ASSERT_OK(AddObject(Mesh, Solid));
	EXPECT_NE(Mesh, TheirMesh);
	EXPECT_NE(Object, TheirObject);
	const double Transform[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
	EXPECT_REFUSED(Other->SetMaterial(Solid, {}), "of another renderer");
	EXPECT_REFUSED(Other->RemoveMaterial(Solid), "of another renderer");
	EXPECT_REFUSED(Other->UpdateMeshVertices(Mesh, TrianglePositions, nullptr), "of another renderer");
	EXPECT_REFUSED(Other->RemoveMesh(Mesh), "of another renderer");
	EXPECT_REFUSED(Other->SetObjectTransform(Object, Transform), "of another renderer");
	EXPECT_REFUSED(Other->SetObjectMaterials(Object, &Theirs, 1), "of another renderer");
	EXPECT_REFUSED(Other->SetObjectMaterials(TheirObject, &Solid, 1), "no such material");
	EXPECT_REFUSED(Other->SetObjectCastsShadow(Object, false), "of another renderer");
	EXPECT_REFUSED(Other->RemoveObject(Object), "of another renderer");
	Desc.Mesh = Mesh;
	EXPECT_REFUSED(Other->AddObject(Desc, &TheirObject), "of another renderer");
	EXPECT_EQ(TheirObject, ERTObjectHandle::None);
	ASSERT_OK(Renderer->SetObjectTransform(Object, Transform)); // nothing has happened to it
}

TEST_F(FModuleArgumentTest, WrongCallsFromSeveralThreadsAreRefusedWhileFramesGoOn)
{
	ASSERT_OK(AddObject(AddMesh(DescribeTriangle()), Solid));
	ASSERT_OK(SetSun(-1.0));
	std::atomic<uint32_t> Wrong = 0, Done = 0;
	const auto Misuse = [&] {
		const double Transform[12] = {std::numeric_limits<double>::quiet_NaN()};
		const auto Refused = [&](const FRTStatus& Status) { Wrong += Status.Code != ERTResult::InvalidArgument || Status.Message[0] == 0; };
		for (uint64_t Round = 0; Round < 500; ++Round)
		{
			const uint64_t Bits = Round * 0x9E3779B97F4A7C15 | 1ull << 63; // no renderer of this test has such a tag
			Refused(Renderer->AddMesh({}, nullptr));
			Refused(Renderer->RemoveMesh(static_cast<ERTMeshHandle>(Bits)));
			Refused(Renderer->SetMaterial(static_cast<ERTMaterialHandle>(Bits), {}));
			Refused(Renderer->SetObjectTransform(Object, Transform));
			Refused(Renderer->RemoveObject(static_cast<ERTObjectHandle>(Bits)));
			Refused(Renderer->SetObjectMaterials(Object, nullptr, ~0u));
		}
		++Done;
	};
	std::vector<std::thread> Threads;
	for (int Thread = 0; Thread < 3; ++Thread) { Threads.emplace_back(Misuse); }
	while (Done < Threads.size()) { EXPECT_TRUE(RenderWholeFrame().IsOk()); }
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Wrong, 0u);
	ASSERT_OK(RenderWholeFrame());
}

TEST_F(FModuleArgumentTest, FramesOfTwoThreadsAtOnceAreRefused)
{
	ASSERT_OK(AddObject(AddMesh(DescribeTriangle()), Solid));
	ASSERT_OK(SetSun(-1.0));
	std::atomic<uint32_t> Bad = 0;
	std::mutex ImportMutex;
	const auto Run = [&] {
		for (int Frame = 0; Frame < 200; ++Frame)
		{
			FRTModuleFrame Desc;
			TRTRef<IRTCommandList> Mine;
			{
				std::lock_guard Lock(ImportMutex);
				Desc = DescribeFrame();
				Mine = List;
			}
			FRTModuleOutputs Made;
			const ERTResult Rendered = Renderer->RenderFrame(Desc, &Made).Code;
			const ERTResult Ended = Renderer->EndFrame(nullptr).Code;
			for (const ERTResult Code : {Rendered, Ended}) { Bad += Code != ERTResult::Ok && Code != ERTResult::InvalidArgument; }
		}
	};
	std::thread Second(Run);
	Run();
	Second.join();
	EXPECT_EQ(Bad, 0u);
	(void)Renderer->EndFrame(nullptr); // a last frame that the other thread could not end
	ASSERT_OK(RenderWholeFrame());
}

} // namespace
} // namespace Lantern
