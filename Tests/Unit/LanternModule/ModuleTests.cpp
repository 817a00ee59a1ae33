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
	ASSERT_FINE(AddObject(Wall, Solid));
	EXPECT_REFUSED(Renderer->SetObjectMaterials(Object, &Masked, 1), "mesh \"Wall\": section 0");
	FRTModuleMaterial Material;
	Material.bMasked = true;
	EXPECT_REFUSED(Renderer->SetMaterial(Solid, Material), "mesh \"Wall\": section 0");
	ASSERT_FINE(Renderer->RemoveObject(Object));
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
	ASSERT_FINE(AddObject(Mesh, Solid));
	ASSERT_FINE(Renderer->RemoveObject(Object));
	EXPECT_REFUSED(Renderer->RemoveObject(Object), "no such object");
	ASSERT_FINE(Renderer->RemoveMesh(Mesh));
	EXPECT_REFUSED(Renderer->RemoveMesh(Mesh), "no such mesh");
}

TEST_F(FModuleTest, RemovedMeshesSlotIsUsedAgainAndItsHandleIsNot)
{
	const ERTMeshHandle First = AddMesh(DescribeTriangle());
	ASSERT_FINE(Renderer->RemoveMesh(First));
	const ERTMeshHandle Second = AddMesh(DescribeTriangle());
	EXPECT_NE(First, Second);
	EXPECT_EQ(static_cast<uint32_t>(First), static_cast<uint32_t>(Second));
	EXPECT_REFUSED(AddObject(First, Solid), "no such mesh");
	EXPECT_TRUE(AddObject(Second, Solid).IsOk());
}

TEST_F(FModuleTest, MeshInUseCannotBeRemoved)
{
	const ERTMeshHandle Wall = AddOpaqueMesh();
	ASSERT_FINE(AddObject(Wall, Solid));
	const ERTObjectHandle First = Object;
	ASSERT_FINE(AddObject(Wall, Solid));
	EXPECT_REFUSED(Renderer->RemoveMesh(Wall), "2 objects still use mesh \"Wall\"");
	ASSERT_FINE(Renderer->SetObjectCastsShadow(First, false));
	ASSERT_FINE(Renderer->RemoveObject(First));
	EXPECT_REFUSED(Renderer->RemoveMesh(Wall), "1 objects still use mesh \"Wall\"");
	ASSERT_FINE(SetSun(-1.0));
	ASSERT_FINE(RenderWholeFrame());
	ASSERT_FINE(Renderer->RemoveObject(Object));
	ASSERT_FINE(Renderer->RemoveMesh(Wall));
	for (int Frame = 0; Frame < 3; ++Frame) { ASSERT_FINE(RenderWholeFrame()); }
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Destroy, "Wall") > 0, true) << "its memory was kept";
}

TEST_F(FModuleTest, HandleOfARemovedMeshIsRefusedWithItsName)
{
	const ERTMeshHandle Wall = AddOpaqueMesh();
	ASSERT_FINE(Renderer->RemoveMesh(Wall));
	EXPECT_REFUSED(Renderer->RemoveMesh(Wall), "no such mesh: \"Wall\" was removed");
	EXPECT_REFUSED(AddObject(Wall, Solid), "AddObject: no such mesh: \"Wall\" was removed");
	EXPECT_REFUSED(Renderer->UpdateMeshVertices(Wall, TrianglePositions, nullptr), "\"Wall\" was removed");
	const ERTMeshHandle Triangle = AddMesh(DescribeTriangle()); // in the same slot
	EXPECT_REFUSED(AddObject(Wall, Solid), "\"Wall\" was removed");
	ASSERT_FINE(Renderer->RemoveMesh(Triangle));
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
	ASSERT_FINE(Render());
	const TRTRef<IRTCommandList> First = List;
	EXPECT_REFUSED(Renderer->RenderFrame(DescribeFrame(), &Outputs), "EndFrame was not called");
	EXPECT_TRUE(Renderer->EndFrame(nullptr).IsOk());
}

TEST_F(FModuleTest, ReplacedTextureStaysUntilTheFrameInTheMakingHasRun)
{
	FTexturedMaterial Leaf = MakeTexturedMaterial("Leaf");
	ASSERT_FINE(Renderer->SetMaterial(Solid, Leaf.Material));
	Leaf.Texture.Reset();
	Mock().SetManualFences(true);
	ASSERT_FINE(Render());
	ASSERT_FINE(Renderer->SetMaterial(Solid, {}));
	EXPECT_EQ(CountDestroyed("Leaf"), 0u) << "the recorded list may sample it";
	FRTFence Fence = 0;
	ASSERT_FINE(Renderer->EndFrame(&Fence));
	ASSERT_FINE(RenderWholeFrame()); // takes the change over
	EXPECT_EQ(CountDestroyed("Leaf"), 0u) << "the frame is in flight";
	Mock().SetManualFences(false);
	EXPECT_EQ(CountDestroyed("Leaf"), 1u);
}

TEST_F(FModuleTest, StructuresAreBuiltWithinTheBudget)
{
	ASSERT_FINE(Module->SetConsoleVariable("r.RT.Build.TrianglesPerFrame", "1"));
	for (int Mesh = 0; Mesh < 3; ++Mesh) { ASSERT_FINE(AddObject(AddOpaqueMesh(), Solid)); }
	ASSERT_FINE(SetSun(-1.0));
	for (uint32_t Frame = 1; Frame <= 3; ++Frame)
	{
		ASSERT_FINE(Render());
		EXPECT_EQ(Outputs.bComplete, Frame == 3);
		EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
		ASSERT_FINE(Renderer->EndFrame(nullptr));
		EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), Frame);
	}
	ASSERT_FINE(Module->SetConsoleVariable("r.RT.Build.TrianglesPerFrame", "500000"));
}

TEST_F(FModuleTest, RemovedMaterialsHandleIsVoidAndItsPlaceIsUsedAgain)
{
	const ERTMeshHandle Mesh = AddMesh(DescribeTriangle());
	ERTMaterialHandle Moss = ERTMaterialHandle::None, Stone = ERTMaterialHandle::None;
	ASSERT_FINE(Renderer->AddMaterial({}, &Moss));
	ASSERT_FINE(AddObject(Mesh, Moss));
	const ERTObjectHandle First = Object;
	ASSERT_FINE(AddObject(Mesh, Solid));
	ASSERT_FINE(Renderer->SetObjectMaterials(Object, &Moss, 1));
	EXPECT_REFUSED(Renderer->RemoveMaterial(Moss), "2 sections of objects still use it");
	ASSERT_FINE(Renderer->SetObjectCastsShadow(First, false));
	ASSERT_FINE(Renderer->RemoveObject(First));
	EXPECT_REFUSED(Renderer->RemoveMaterial(Moss), "1 sections of objects still use it");
	ASSERT_FINE(SetSun(-1.0));
	ASSERT_FINE(Render());
	ASSERT_FINE(Renderer->SetObjectMaterials(Object, &Solid, 1)); // while the frame that has it is in the making
	ASSERT_FINE(Renderer->RemoveMaterial(Moss));
	ASSERT_FINE(Renderer->EndFrame(nullptr));
	EXPECT_REFUSED(Renderer->RemoveMaterial(Moss), "no such material");
	EXPECT_REFUSED(Renderer->SetMaterial(Moss, {}), "no such material");
	EXPECT_REFUSED(Renderer->SetObjectMaterials(Object, &Moss, 1), "no such material");
	EXPECT_REFUSED(Renderer->RemoveMaterial(ERTMaterialHandle::None), "no such material");
	ASSERT_FINE(Renderer->AddMaterial({}, &Stone));
	EXPECT_EQ(static_cast<uint32_t>(Stone), static_cast<uint32_t>(Moss)) << "its place is lost";
	EXPECT_NE(Stone, Moss);
	EXPECT_REFUSED(AddObject(Mesh, Moss), "no such material");
	ASSERT_FINE(AddObject(Mesh, Stone));
	ASSERT_FINE(RenderWholeFrame());
}

TEST_F(FModuleTest, RemovedMaterialsTextureStaysUntilTheFrameInTheMakingHasRun)
{
	FTexturedMaterial Bark = MakeTexturedMaterial("Bark");
	ERTMaterialHandle Tree = ERTMaterialHandle::None;
	ASSERT_FINE(Renderer->AddMaterial(Bark.Material, &Tree));
	Bark.Texture.Reset();
	Mock().SetManualFences(true);
	ASSERT_FINE(Render());
	ASSERT_FINE(Renderer->RemoveMaterial(Tree));
	EXPECT_EQ(CountDestroyed("Bark"), 0u) << "the recorded list may sample it";
	ASSERT_FINE(Renderer->EndFrame(nullptr));
	ASSERT_FINE(RenderWholeFrame()); // takes the change over
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
		ASSERT_FINE(Module->SetConsoleVariable("r.RT.Shadow.Path", GetParam()));
		ASSERT_FINE(AddObject(AddOpaqueMesh(), Solid));
		SetSoftSun();
	}
	void TearDown() override
	{
		for (const char* Name : {"r.RT.Shadow.Path", "r.RT.Shadow.Denoise"})
		{
			ASSERT_FINE(Module->SetConsoleVariable(Name, Name == std::string("r.RT.Shadow.Path") ? "0" : "1"));
		}
		FModuleTest::TearDown();
	}
	void LetGo() { Mock().ClearCompileFaults(); }
	void RenderAndEnd()
	{
		Mock().ClearCalls();
		ASSERT_FINE(Render());
		ASSERT_FINE(Renderer->EndFrame(nullptr));
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
	ASSERT_FINE(AddObject(AddMesh(DescribeTriangle()), Masked));
	ASSERT_NO_FATAL_FAILURE(RenderWhile(""));
	ASSERT_NO_FATAL_FAILURE(RenderUntilOneIsInTheDriver());
	EXPECT_FALSE(Outputs.bShadersReady);
	if (*GetParam() == '1') { EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr) << "the pipeline before serves"; }
	LetGo();
	ASSERT_NO_FATAL_FAILURE(RenderUntilComplete());
	ASSERT_FINE(SetSun(-1.0, 0.0f));
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
	ASSERT_FINE(Renderer->Precache(DescribeFrame(), Report, &Progress));
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
	ASSERT_FINE(Render());
	EXPECT_REFUSED(Renderer->Precache(DescribeFrame(), nullptr, nullptr), "EndFrame was not called");
	ASSERT_FINE(Renderer->EndFrame(nullptr));
}

INSTANTIATE_TEST_SUITE_P(
    Paths, FModuleCompileTest, ::testing::Values("1", "2"), [](const auto& Info) { return *Info.param == '1' ? "Pipeline" : "Query"; });

TEST_F(FModuleTest, DeformedVerticesAreCopiedOnceAndRefitted)
{
	const ERTMeshHandle Rigid = AddMesh(DescribeTriangle());
	EXPECT_REFUSED(Renderer->UpdateMeshVertices(Rigid, TrianglePositions, nullptr), "without bDeformable");
	const ERTMeshHandle Cloth = AddDeformableMesh();
	ASSERT_FINE(AddObject(Cloth, Solid));
	ASSERT_FINE(SetSun(-1.0));
	ASSERT_FINE(RenderWholeFrame());

	Mock().ClearCalls();
	const float Moved[] = {0, 0, 1, 2, 0, 0, 0, 3, 0};
	const float Broken[] = {0, 0, std::numeric_limits<float>::infinity(), 2, 0, 0, 0, 3, 0};
	EXPECT_REFUSED(Renderer->UpdateMeshVertices(Cloth, Broken, nullptr), "not finite");
	ASSERT_FINE(Renderer->UpdateMeshVertices(Cloth, TrianglePositions, nullptr));
	ASSERT_FINE(Renderer->UpdateMeshVertices(Cloth, Moved, nullptr));
	ASSERT_FINE(RenderWholeFrame());
	EXPECT_EQ(CountCopies("Cloth"), 1u) << "positions and attributes at once, of the last call only";
	const std::vector<FRTMockCall> Builds = Mock().FindCalls(ERTMockCall::BuildGeometry, "Cloth");
	ASSERT_EQ(Builds.size(), 1u);
	EXPECT_EQ(Builds[0].Numbers[1], 1u) << "a refit";

	Mock().ClearCalls();
	ASSERT_FINE(RenderWholeFrame());
	EXPECT_EQ(CountCopies("Cloth"), 0u) << "nothing is new";
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), 0u);
}

TEST_F(FModuleTest, VerticesOfALostFrameAreCopiedAgain)
{
	const ERTMeshHandle Cloth = AddDeformableMesh();
	ASSERT_FINE(AddObject(Cloth, Solid));
	ASSERT_FINE(SetSun(-1.0));
	ASSERT_FINE(Renderer->UpdateMeshVertices(Cloth, TrianglePositions, nullptr));
	Mock().FailEveryAllocation(1);
	EXPECT_FALSE(Render().IsOk());
	Mock().FailEveryAllocation(0);
	Mock().ClearCalls();
	ASSERT_FINE(Render());
	EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
	ASSERT_FINE(Renderer->EndFrame(nullptr));
	EXPECT_EQ(CountCopies("Cloth"), 2u) << "the mesh, and its new vertices";
}

} // namespace
} // namespace Lantern
