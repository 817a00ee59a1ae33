// What the module says of names that an engine gave it: an engine's log may be anything.
#include "ModuleTestTools.h"
#include "Support/TextCheck.h"

namespace Lantern
{
namespace
{

const std::string Worse = "\x1b[31m\xff\u0085\u202E\nerror: forged";
constexpr const char* WorseShown = "\\x1b[31m\\xff\\u{0085}\\u{202e}\\nerror: forged";

#define EXPECT_REFUSED_CLEANLY(Expression, Part)                                                                                           \
	do {                                                                                                                                   \
		const FRTStatus Clean = (Expression);                                                                                              \
		EXPECT_FALSE(Clean.IsOk());                                                                                                        \
		EXPECT_TRUE(IsCleanText(Clean.Message)) << testing::PrintToString(Clean.Message);                                                  \
		EXPECT_THAT(Clean.Message, ::testing::HasSubstr(Part));                                                                            \
	}                                                                                                                                      \
	while (false)

TEST_F(FModuleTest, NamesOfMeshesAreShownAsEscapes)
{
	FRTModuleMesh Mesh = DescribeTriangle();
	Mesh.Name = Worse.c_str();
	const ERTMeshHandle Handle = AddMesh(Mesh);
	EXPECT_REFUSED_CLEANLY(AddObject(Handle, static_cast<ERTMaterialHandle>(77)), WorseShown);
	ASSERT_OK(AddObject(Handle, Solid));
	EXPECT_REFUSED_CLEANLY(Renderer->SetObjectMaterials(Object, nullptr, 0), WorseShown);
	EXPECT_REFUSED_CLEANLY(Renderer->UpdateMeshVertices(Handle, TrianglePositions, nullptr), WorseShown);
	EXPECT_REFUSED_CLEANLY(Renderer->RemoveMesh(Handle), WorseShown);
	ASSERT_OK(Renderer->RemoveObject(Object));
	ASSERT_OK(Renderer->RemoveMesh(Handle));
	EXPECT_REFUSED_CLEANLY(Renderer->RemoveMesh(Handle), WorseShown);
	ERTMeshHandle None = ERTMeshHandle::None;
	Mesh.IndexCount = 2;
	EXPECT_REFUSED_CLEANLY(Renderer->AddMesh(Mesh, &None), WorseShown);
}

TEST_F(FModuleTest, LongNamesLeaveRoomForTheReason)
{
	for (const char* Piece : {"n", "ä", "\xff", "\u202E"})
	{
		std::string Name;
		while (Name.size() < 5000) { Name += Piece; }
		FRTModuleMesh Mesh = DescribeTriangle();
		Mesh.Name = Name.c_str();
		Mesh.IndexCount = 2;
		ERTMeshHandle None = ERTMeshHandle::None;
		EXPECT_REFUSED_CLEANLY(Renderer->AddMesh(Mesh, &None), "…\": IndexCount is 0, above");
	}
}

TEST_F(FModuleTest, SettingsAndFoldersAreShownAsEscapes)
{
	char Value[16];
	EXPECT_REFUSED_CLEANLY(Module->SetConsoleVariable(Worse.c_str(), "1"), WorseShown);
	EXPECT_REFUSED_CLEANLY(Module->SetConsoleVariable("r.RT.Shadow.Samples", Worse.c_str()), WorseShown);
	EXPECT_REFUSED_CLEANLY(Module->SetConsoleVariable(("sg." + Worse).c_str(), Worse.c_str()), WorseShown);
	EXPECT_REFUSED_CLEANLY(Module->GetConsoleVariable(Worse.c_str(), Value, sizeof(Value)), WorseShown);
	Renderer.Reset();
	Module.Reset(); // a module is initialised once
	ASSERT_EQ(LanternCreateModule(ModuleVersion, Module.ReleaseAndGetAddress()), 0);
	FRTModuleDesc Desc;
	Desc.ShaderFolder = Worse.c_str();
	EXPECT_REFUSED_CLEANLY(Module->Initialize(Desc), WorseShown);
	Desc.ShaderFolder = LANTERN_SOURCE_DIR "/Shaders";
	Desc.ConfigFolder = Worse.c_str();
	EXPECT_REFUSED_CLEANLY(Module->Initialize(Desc), WorseShown);
}

} // namespace
} // namespace Lantern
