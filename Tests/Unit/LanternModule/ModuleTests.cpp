// The plugin's library through its one entry point, on a mock device: what it refuses and how, and what it keeps.
#include <limits>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

TEST_F(FModuleTest, MaskedMaterialOnAnOpaqueSectionIsRefusedByName)
{
	const ERTMeshHandle Wall = AddOpaqueMesh();
	EXPECT_REFUSED(AddObject(Wall, Masked), "mesh \"Wall\": section 0");
	ASSERT_OK(AddObject(Wall, Solid));
	EXPECT_REFUSED(Renderer->SetObjectMaterials(Object, &Masked, 1), "mesh \"Wall\": section 0");
	FRTModuleMaterial Material;
	Material.bMasked = true;
	EXPECT_REFUSED(Renderer->SetMaterial(Solid, Material), "mesh \"Wall\": section 0");
	ASSERT_OK(Renderer->RemoveObject(Object));
	EXPECT_TRUE(Renderer->SetMaterial(Solid, Material).IsOk()) << "nothing uses it any more";
}

TEST_F(FModuleTest, MeshWithoutSectionsMayBeMasked)
{
	EXPECT_TRUE(AddObject(AddMesh(DescribeTriangle()), Masked).IsOk());
	EXPECT_TRUE(Renderer->SetObjectMaterials(Object, &Solid, 1).IsOk());
}

TEST_F(FModuleTest, StaleAndForeignHandlesAreRefused)
{
	const ERTMeshHandle Mesh = AddMesh(DescribeTriangle());
	const auto Unknown = static_cast<ERTMaterialHandle>(77);
	EXPECT_REFUSED(AddObject(ERTMeshHandle::None, Solid), "no such mesh");
	EXPECT_REFUSED(AddObject(static_cast<ERTMeshHandle>(99), Solid), "no such mesh");
	EXPECT_REFUSED(AddObject(Mesh, Unknown), "no such material");
	EXPECT_REFUSED(AddObject(Mesh, ERTMaterialHandle::None), "no such material");
	EXPECT_REFUSED(Renderer->SetMaterial(ERTMaterialHandle::None, {}), "no such material");
	EXPECT_REFUSED(Renderer->SetObjectCastsShadow(ERTObjectHandle::None, true), "no such object");
	ASSERT_OK(AddObject(Mesh, Solid));
	ASSERT_OK(Renderer->RemoveObject(Object));
	EXPECT_REFUSED(Renderer->RemoveObject(Object), "no such object");
	ASSERT_OK(Renderer->RemoveMesh(Mesh));
	EXPECT_REFUSED(Renderer->RemoveMesh(Mesh), "no such mesh");
}

TEST_F(FModuleTest, RemovedMeshesSlotIsUsedAgainAndItsHandleIsNot)
{
	const ERTMeshHandle First = AddMesh(DescribeTriangle());
	ASSERT_OK(Renderer->RemoveMesh(First));
	const ERTMeshHandle Second = AddMesh(DescribeTriangle());
	EXPECT_NE(First, Second);
	EXPECT_EQ(static_cast<uint32_t>(First), static_cast<uint32_t>(Second));
	EXPECT_REFUSED(AddObject(First, Solid), "no such mesh");
	EXPECT_TRUE(AddObject(Second, Solid).IsOk());
}

TEST_F(FModuleTest, MeshInUseCannotBeRemoved)
{
	const ERTMeshHandle Wall = AddOpaqueMesh();
	ASSERT_OK(AddObject(Wall, Solid));
	const ERTObjectHandle First = Object;
	ASSERT_OK(AddObject(Wall, Solid));
	EXPECT_REFUSED(Renderer->RemoveMesh(Wall), "2 objects still use mesh \"Wall\"");
	ASSERT_OK(Renderer->SetObjectCastsShadow(First, false));
	ASSERT_OK(Renderer->RemoveObject(First));
	EXPECT_REFUSED(Renderer->RemoveMesh(Wall), "1 objects still use mesh \"Wall\"");
	ASSERT_OK(SetSun(-1.0));
	ASSERT_OK(RenderWholeFrame());
	ASSERT_OK(Renderer->RemoveObject(Object));
	ASSERT_OK(Renderer->RemoveMesh(Wall));
	for (int Frame = 0; Frame < 3; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Destroy, "Wall") > 0, true) << "its memory was kept";
}

TEST_F(FModuleTest, HandleOfARemovedMeshIsRefusedWithItsName)
{
	const ERTMeshHandle Wall = AddOpaqueMesh();
	ASSERT_OK(Renderer->RemoveMesh(Wall));
	EXPECT_REFUSED(Renderer->RemoveMesh(Wall), "no such mesh: \"Wall\" was removed");
	EXPECT_REFUSED(AddObject(Wall, Solid), "AddObject: no such mesh: \"Wall\" was removed");
	EXPECT_REFUSED(Renderer->UpdateMeshVertices(Wall, TrianglePositions, nullptr), "\"Wall\" was removed");
	const ERTMeshHandle Triangle = AddMesh(DescribeTriangle()); // in the same slot
	EXPECT_REFUSED(AddObject(Wall, Solid), "\"Wall\" was removed");
	ASSERT_OK(Renderer->RemoveMesh(Triangle));
	EXPECT_REFUSED(AddObject(Triangle, Solid), "\"Triangle\" was removed");
	EXPECT_REFUSED(AddObject(Wall, Solid), "no such mesh: never added, removed, or of another renderer");
}

TEST_F(FModuleTest, SunWithoutDirectionIsRefused)
{
	EXPECT_REFUSED(SetSun(0.0), "Direction is zero");
	EXPECT_REFUSED(SetSun(std::numeric_limits<double>::quiet_NaN()), "not finite");
	EXPECT_REFUSED(SetSun(-1.0, -2.0f), "Irradiance");
	EXPECT_TRUE(SetSun(-3.0).IsOk());
}

TEST_F(FModuleTest, WrongGBufferIsRefused)
{
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Depth = nullptr;
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "FRTModuleFrame::Depth is null");
	const TRTRef<IRTTexture> Small = MakeTexture(ERTFormat::D32_FLOAT, 32);
	Frame.Depth = Small.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "the normals texture is 64 x 64, depth is 32 x 32");
	Frame.Depth = Normals.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "D32_FLOAT");
	Frame.Depth = Frame.Normals = Depth.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "RGBA16_SNORM");
	const TRTRef<IRTTexture> Unsampled = MakeTexture(ERTFormat::RGBA16_SNORM, 64, ERTTextureUsage::RenderTarget);
	Frame.Normals = Unsampled.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "Sampled");
	Frame.Normals = Normals.Get();
	Frame.DepthAccess = ERTAccess::None;
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "DepthAccess");
}

TEST_F(FModuleTest, FramesOutOfOrderAreRefused)
{
	EXPECT_REFUSED(Renderer->EndFrame(nullptr), "RenderFrame recorded nothing");
	ASSERT_OK(Render());
	const TRTRef<IRTCommandList> First = List;
	EXPECT_REFUSED(Renderer->RenderFrame(DescribeFrame(), &Outputs), "EndFrame was not called");
	EXPECT_TRUE(Renderer->EndFrame(nullptr).IsOk());
}

TEST_F(FModuleTest, ReplacedTextureStaysUntilTheFrameInTheMakingHasRun)
{
	FTexturedMaterial Leaf = MakeTexturedMaterial("Leaf");
	ASSERT_OK(Renderer->SetMaterial(Solid, Leaf.Material));
	Leaf.Texture.Reset();
	Mock().SetManualFences(true);
	ASSERT_OK(Render());
	ASSERT_OK(Renderer->SetMaterial(Solid, {}));
	EXPECT_EQ(CountDestroyed("Leaf"), 0u) << "the recorded list may sample it";
	FRTFence Fence = 0;
	ASSERT_OK(Renderer->EndFrame(&Fence));
	ASSERT_OK(RenderWholeFrame()); // takes the change over
	EXPECT_EQ(CountDestroyed("Leaf"), 0u) << "the frame is in flight";
	Mock().SetManualFences(false);
	EXPECT_EQ(CountDestroyed("Leaf"), 1u);
}

TEST_F(FModuleTest, StructuresAreBuiltWithinTheBudget)
{
	ASSERT_OK(Module->SetConsoleVariable("r.RT.Build.TrianglesPerFrame", "1"));
	for (int Mesh = 0; Mesh < 3; ++Mesh) { ASSERT_OK(AddObject(AddOpaqueMesh(), Solid)); }
	ASSERT_OK(SetSun(-1.0));
	for (uint32_t Frame = 1; Frame <= 3; ++Frame)
	{
		ASSERT_OK(Render());
		EXPECT_EQ(Outputs.bComplete, Frame == 3);
		EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
		ASSERT_OK(Renderer->EndFrame(nullptr));
		EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), Frame);
	}
	ASSERT_OK(Module->SetConsoleVariable("r.RT.Build.TrianglesPerFrame", "500000"));
}

TEST_F(FModuleTest, RemovedMaterialsHandleIsVoidAndItsPlaceIsUsedAgain)
{
	const ERTMeshHandle Mesh = AddMesh(DescribeTriangle());
	ERTMaterialHandle Moss = ERTMaterialHandle::None, Stone = ERTMaterialHandle::None;
	ASSERT_OK(Renderer->AddMaterial({}, &Moss));
	ASSERT_OK(AddObject(Mesh, Moss));
	const ERTObjectHandle First = Object;
	ASSERT_OK(AddObject(Mesh, Solid));
	ASSERT_OK(Renderer->SetObjectMaterials(Object, &Moss, 1));
	EXPECT_REFUSED(Renderer->RemoveMaterial(Moss), "2 sections of objects still use it");
	ASSERT_OK(Renderer->SetObjectCastsShadow(First, false));
	ASSERT_OK(Renderer->RemoveObject(First));
	EXPECT_REFUSED(Renderer->RemoveMaterial(Moss), "1 sections of objects still use it");
	ASSERT_OK(SetSun(-1.0));
	ASSERT_OK(Render());
	ASSERT_OK(Renderer->SetObjectMaterials(Object, &Solid, 1)); // while the frame that has it is in the making
	ASSERT_OK(Renderer->RemoveMaterial(Moss));
	ASSERT_OK(Renderer->EndFrame(nullptr));
	EXPECT_REFUSED(Renderer->RemoveMaterial(Moss), "no such material");
	EXPECT_REFUSED(Renderer->SetMaterial(Moss, {}), "no such material");
	EXPECT_REFUSED(Renderer->SetObjectMaterials(Object, &Moss, 1), "no such material");
	EXPECT_REFUSED(Renderer->RemoveMaterial(ERTMaterialHandle::None), "no such material");
	ASSERT_OK(Renderer->AddMaterial({}, &Stone));
	EXPECT_EQ(static_cast<uint32_t>(Stone), static_cast<uint32_t>(Moss)) << "its place is lost";
	EXPECT_NE(Stone, Moss);
	EXPECT_REFUSED(AddObject(Mesh, Moss), "no such material");
	ASSERT_OK(AddObject(Mesh, Stone));
	ASSERT_OK(RenderWholeFrame());
}

TEST_F(FModuleTest, RemovedMaterialsTextureStaysUntilTheFrameInTheMakingHasRun)
{
	FTexturedMaterial Bark = MakeTexturedMaterial("Bark");
	ERTMaterialHandle Tree = ERTMaterialHandle::None;
	ASSERT_OK(Renderer->AddMaterial(Bark.Material, &Tree));
	Bark.Texture.Reset();
	Mock().SetManualFences(true);
	ASSERT_OK(Render());
	ASSERT_OK(Renderer->RemoveMaterial(Tree));
	EXPECT_EQ(CountDestroyed("Bark"), 0u) << "the recorded list may sample it";
	ASSERT_OK(Renderer->EndFrame(nullptr));
	ASSERT_OK(RenderWholeFrame()); // takes the change over
	EXPECT_EQ(CountDestroyed("Bark"), 0u) << "the frame is in flight";
	Mock().SetManualFences(false);
	EXPECT_EQ(CountDestroyed("Bark"), 1u);
}

/// The path of sun shadows: the ray-tracing pipeline, or ray queries in a compute shader.
class FModuleCompileTest : public FModuleTest, public ::testing::WithParamInterface<const char*>
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		bPrecache = false;
		ASSERT_OK(Module->SetConsoleVariable("r.RT.Shadow.Path", GetParam()));
		ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
		SetSoftSun();
	}
	void TearDown() override
	{
		for (const char* Name : {"r.RT.Shadow.Path", "r.RT.Shadow.Denoise"})
		{
			ASSERT_OK(Module->SetConsoleVariable(Name, Name == std::string("r.RT.Shadow.Path") ? "0" : "1"));
		}
		FModuleTest::TearDown();
	}
	void LetGo() { Mock().ClearCompileFaults(); }
	void RenderAndEnd()
	{
		Mock().ClearCalls();
		ASSERT_OK(Render());
		ASSERT_OK(Renderer->EndFrame(nullptr));
		GiveWay();
	}
	/// A frame while the driver holds Part; a frame that waited would wait for ever.
	void RenderWhile(const char* Part)
	{
		Mock().HoldCompiles(Part);
		const FHangGuard Guard(std::string("a frame while the driver holds ") + Part, [&] { LetGo(); });
		ASSERT_NO_FATAL_FAILURE(RenderAndEnd());
	}
	/// After RenderWhile.
	void RenderUntilOneIsInTheDriver()
	{
		const FHangGuard Guard("frames while something is compiled", [&] { LetGo(); });
		ASSERT_TRUE(WaitUntil(
		    "a compile in the driver", [&] { return Mock().GetCompilesInDriver() > 0; }, [&] { RenderAndEnd(); }));
		for (int Frame = 0; Frame < 5; ++Frame) { ASSERT_NO_FATAL_FAILURE(RenderAndEnd()); }
	}
	void RenderUntilComplete()
	{
		const auto Step = [&] {
			RenderAndEnd();
			EXPECT_TRUE(Outputs.Get(ESignal::SunShadow) != nullptr || !Outputs.bComplete);
		};
		ASSERT_TRUE(WaitUntil(
		    "shadows", [&] { return Outputs.bComplete; }, Step));
	}
};

TEST_P(FModuleCompileTest, FramesWaitForNoPipeline)
{
	ASSERT_NO_FATAL_FAILURE(RenderWhile(""));
	EXPECT_EQ(Outputs.Get(ESignal::SunShadow), nullptr);
	EXPECT_FALSE(Outputs.bShadersReady);
	EXPECT_FALSE(Outputs.bComplete);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), 1u) << "structures are built meanwhile";
	ASSERT_NO_FATAL_FAILURE(RenderUntilOneIsInTheDriver());
	EXPECT_EQ(Outputs.Get(ESignal::SunShadow), nullptr);
	LetGo();
	ASSERT_NO_FATAL_FAILURE(RenderUntilComplete());
	EXPECT_TRUE(Outputs.bShadersReady && Outputs.Get(ESignal::SunShadow) != nullptr);

	// A material that must be told apart from solid ones: it is said that its shaders are not there.
	ASSERT_OK(AddObject(AddMesh(DescribeTriangle()), Masked));
	ASSERT_NO_FATAL_FAILURE(RenderWhile(""));
	ASSERT_NO_FATAL_FAILURE(RenderUntilOneIsInTheDriver());
	EXPECT_FALSE(Outputs.bShadersReady);
	if (*GetParam() == '1') { EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr) << "the pipeline before serves"; }
	LetGo();
	ASSERT_NO_FATAL_FAILURE(RenderUntilComplete());
	ASSERT_OK(SetSun(-1.0, 0.0f));
	ASSERT_NO_FATAL_FAILURE(RenderAndEnd());
	EXPECT_TRUE(Outputs.bComplete) << "without a sun nothing is missing";
	EXPECT_EQ(Outputs.Get(ESignal::SunShadow), nullptr);
}

TEST_P(FModuleCompileTest, ShadowsAreThereWithoutTheirFilter)
{
	ASSERT_NO_FATAL_FAILURE(RenderWhile("Denoise/"));
	const auto HasShadows = [&] { return Outputs.Get(ESignal::SunShadow) != nullptr; };
	ASSERT_TRUE(WaitUntil("shadows without a filter", HasShadows, [&] { RenderAndEnd(); }));
	EXPECT_FALSE(Outputs.bShadersReady);
	const auto HasFilter = [&] { return Mock().CountCalls(ERTMockCall::BeginMarker, "SunShadowTemporal") > 0; };
	EXPECT_FALSE(HasFilter());
	LetGo();
	ASSERT_NO_FATAL_FAILURE(RenderUntilComplete());
	EXPECT_TRUE(HasFilter());
}

TEST_P(FModuleCompileTest, PrecacheMakesTheFirstFrameComplete)
{
	std::vector<float> Progress;
	const auto Report = [](void* User, float Done) { static_cast<std::vector<float>*>(User)->push_back(Done); };
	ASSERT_OK(Renderer->Precache(DescribeFrame(), Report, &Progress));
	ASSERT_FALSE(Progress.empty());
	EXPECT_TRUE(std::is_sorted(Progress.begin(), Progress.end()));
	EXPECT_FLOAT_EQ(Progress.back(), 1.0f);
	for (int Frame = 0; Frame < 3; ++Frame)
	{
		ASSERT_NO_FATAL_FAILURE(RenderWhile(""));
		EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
		EXPECT_TRUE(Outputs.bShadersReady);
		EXPECT_EQ(Mock().GetCreatedPipelines(), std::vector<std::string>());
	}
	ASSERT_OK(Render());
	EXPECT_REFUSED(Renderer->Precache(DescribeFrame(), nullptr, nullptr), "EndFrame was not called");
	ASSERT_OK(Renderer->EndFrame(nullptr));
}

INSTANTIATE_TEST_SUITE_P(
    Paths, FModuleCompileTest, ::testing::Values("1", "2"), [](const auto& Info) { return *Info.param == '1' ? "Pipeline" : "Query"; });

TEST_F(FModuleTest, DeformedVerticesAreCopiedOnceAndRefitted)
{
	const ERTMeshHandle Rigid = AddMesh(DescribeTriangle());
	EXPECT_REFUSED(Renderer->UpdateMeshVertices(Rigid, TrianglePositions, nullptr), "without bDeformable");
	const ERTMeshHandle Cloth = AddDeformableMesh();
	ASSERT_OK(AddObject(Cloth, Solid));
	ASSERT_OK(SetSun(-1.0));
	ASSERT_OK(RenderWholeFrame());

	Mock().ClearCalls();
	const float Moved[] = {0, 0, 1, 2, 0, 0, 0, 3, 0};
	const float Broken[] = {0, 0, std::numeric_limits<float>::infinity(), 2, 0, 0, 0, 3, 0};
	EXPECT_REFUSED(Renderer->UpdateMeshVertices(Cloth, Broken, nullptr), "not finite");
	ASSERT_OK(Renderer->UpdateMeshVertices(Cloth, TrianglePositions, nullptr));
	ASSERT_OK(Renderer->UpdateMeshVertices(Cloth, Moved, nullptr));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountCopies("Cloth"), 1u) << "positions and attributes at once, of the last call only";
	const std::vector<FRTMockCall> Builds = Mock().FindCalls(ERTMockCall::BuildGeometry, "Cloth");
	ASSERT_EQ(Builds.size(), 1u);
	EXPECT_EQ(Builds[0].Numbers[1], 1u) << "a refit";

	Mock().ClearCalls();
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountCopies("Cloth"), 0u) << "nothing is new";
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), 0u);
}

TEST_F(FModuleTest, VerticesOfALostFrameAreCopiedAgain)
{
	const ERTMeshHandle Cloth = AddDeformableMesh();
	ASSERT_OK(AddObject(Cloth, Solid));
	ASSERT_OK(SetSun(-1.0));
	ASSERT_OK(Renderer->UpdateMeshVertices(Cloth, TrianglePositions, nullptr));
	Mock().FailEveryAllocation(1);
	EXPECT_FALSE(Render().IsOk());
	Mock().FailEveryAllocation(0);
	Mock().ClearCalls();
	ASSERT_OK(Render());
	EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
	ASSERT_OK(Renderer->EndFrame(nullptr));
	EXPECT_EQ(CountCopies("Cloth"), 2u) << "the mesh, and its new vertices";
}

TEST_F(FModuleTest, AMapIsHeldUntilAFrameHasTakenAllCalls)
{
	SetVariable("r.RT.Scene.ArrivalsPerFrame", "1");
	bPrecache = false; // it would take all calls at once
	FTexturedMaterial First = MakeTexturedMaterial("First"), Second = MakeTexturedMaterial("Second");
	ERTMaterialHandle Handle = ERTMaterialHandle::None;
	const auto TakeAll = [&](uint32_t Frames) {
		for (uint32_t Frame = 1; Frame <= Frames; ++Frame)
		{
			ASSERT_OK(Render());
			EXPECT_EQ(Outputs.bCallsTaken, Frame == Frames);
			EXPECT_EQ(CountDestroyed("First") + CountDestroyed("Second"), 0u) << "this frame or another may read it";
			ASSERT_OK(Renderer->EndFrame(nullptr));
		}
	};
	ASSERT_NO_FATAL_FAILURE(TakeAll(2)); // the fixture's materials
	Mock().ClearCalls();
	for (int I = 0; I < 3; ++I) { AddMesh(DescribeTriangle()); }
	ASSERT_OK(Renderer->AddMaterial(First.Material, &Handle));
	ASSERT_OK(Renderer->SetMaterial(Handle, Second.Material));
	First.Texture.Reset();
	ASSERT_NO_FATAL_FAILURE(TakeAll(5));
	EXPECT_EQ(CountDestroyed("First"), 1u);
	Mock().ClearCalls();
	for (int I = 0; I < 3; ++I) { AddMesh(DescribeTriangle()); }
	ASSERT_OK(Renderer->RemoveMaterial(Handle));
	Second.Texture.Reset();
	ASSERT_NO_FATAL_FAILURE(TakeAll(4));
	EXPECT_EQ(CountDestroyed("Second"), 1u);
}

TEST_F(FModuleTest, ThingsOfAnotherDeviceAreRefused)
{
	TRTRef<IRTDevice> Other;
	ASSERT_OK(CreateMockDevice({}, Other.ReleaseAndGetAddress()));
	const auto MakeOther = [&](ERTFormat Format) {
		FRTTextureDesc Desc = Depth->GetDesc();
		Desc.Format = Format;
		TRTRef<IRTTexture> Out;
		EXPECT_OK(Other->ImportTexture(Desc, ++LastNative, Out.ReleaseAndGetAddress()));
		return Out;
	};
	ASSERT_OK(SetSun(-1.0));
	struct FCase
	{
		IRTTexture* FRTModuleFrame::*Member;
		ERTFormat Format;
		const char* Name;
	};
	for (const FCase& Case : {FCase{&FRTModuleFrame::Depth, ERTFormat::D32_FLOAT, "FRTModuleFrame::Depth"},
	         FCase{&FRTModuleFrame::Normals, ERTFormat::RGBA16_SNORM, "FRTModuleFrame::Normals"},
	         FCase{&FRTModuleFrame::GeometricNormals, ERTFormat::RGBA16_SNORM, "FRTModuleFrame::GeometricNormals"},
	         FCase{&FRTModuleFrame::Motion, ERTFormat::RGBA32_FLOAT, "FRTModuleFrame::Motion"},
	         FCase{&FRTModuleFrame::BaseColor, ERTFormat::RGBA8_SRGB, "FRTModuleFrame::BaseColor"},
	         FCase{&FRTModuleFrame::Material, ERTFormat::RGBA8_UNORM, "FRTModuleFrame::Material"}})
	{
		FRTModuleFrame Frame = DescribeFrame();
		const TRTRef<IRTTexture> Wrong = MakeOther(Case.Format);
		Frame.*Case.Member = Wrong.Get();
		EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), Case.Name);
	}
	TRTRef<IRTCommandList> Commands;
	ASSERT_OK(Other->ImportCommandList(++LastNative, Commands.ReleaseAndGetAddress()));
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Commands = Commands.Get();
	EXPECT_REFUSED(Renderer->RenderFrame(Frame, &Outputs), "FRTModuleFrame::Commands");
	EXPECT_OK(RenderWholeFrame());
}

} // namespace
} // namespace Lantern
