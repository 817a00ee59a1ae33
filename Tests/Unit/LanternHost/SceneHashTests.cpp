// Names of content: equal for equal scenes, another one for every single change that a picture could show.
#include <functional>
#include <set>

#include <gmock/gmock.h>

#include "LanternHost/BuiltinScenes.h"
#include "LanternHost/SceneHash.h"
#include "LanternHost/SceneLoader.h"

namespace Lantern
{

namespace
{
FSceneDescription MakeScene()
{
	FSceneDescription Scene;
	Scene.Name = "hash";
	FHostImage Image;
	Image.Width = Image.Height = 2;
	Image.Rgba.resize(16, 7);
	Scene.Images = {Image, Image};
	Scene.Textures = {{.Image = 0}, {.Image = 1}};
	Scene.Materials.resize(2);
	FHostMesh Mesh;
	Mesh.Positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
	Mesh.Attributes.resize(3);
	Mesh.Skin.resize(3);
	Mesh.Indices = {0, 1, 2};
	Mesh.Sections = {{0, 3, 0}};
	Scene.Meshes = {Mesh};
	Scene.Nodes.resize(2);
	Scene.Nodes[0].Mesh = 0;
	Scene.Nodes[0].Materials = {1};
	Scene.Skins = {{{1}, {glm::mat4(1.0f)}}};
	FHostChannel Channel;
	Channel.Node = 1;
	Channel.Times = {0.0f, 1.0f};
	Channel.Values = {glm::vec4(0), glm::vec4(1)};
	Scene.Animations = {{"turn", {Channel}, 1.0f}};
	Scene.Lights.resize(1);
	return Scene;
}

TEST(FSceneHashTest, EqualScenesHaveEqualHashes)
{
	EXPECT_EQ(HashScene(MakeScene()), HashScene(MakeScene()));
	EXPECT_EQ(HashScene(*LoadScene("planes").Scene), HashScene(*LoadScene("planes").Scene));
	EXPECT_NE(HashScene(*LoadScene("furnace:0.5").Scene), HashScene(*LoadScene("furnace:0.7").Scene));
	EXPECT_EQ(HashScene(MakeScene()).ToHex().size(), 32u);
}

TEST(FSceneHashTest, NamesAreNoContent)
{
	FSceneDescription Named = MakeScene();
	Named.Name = Named.Nodes[0].Name = Named.Meshes[0].Name = Named.Images[0].Name = Named.Materials[0].Name = "else";
	Named.Warnings = {"beware"};
	EXPECT_EQ(HashScene(Named), HashScene(MakeScene()));
}

TEST(FSceneHashTest, EveryChangeShows)
{
	using FChange = std::function<void(FSceneDescription&)>;
	const FChange Changes[] = {
	    [](auto& S) {
		S.Images[1].Rgba[15] ^= 1;
	    },
	    [](auto& S) {
		std::swap(S.Images[0], S.Images[1]), S.Images[0].Rgba[0] = 1;
	},
	              [](auto& S) { S.Images[0].Width = 1, S.Images[0].Height = 4; }, [](auto& S) { S.Images[0].bSrgb = true; },
	              [](auto& S) { S.Textures[1].Image = 0; }, [](auto& S) { S.Textures[1].bRepeatV = false; },
	              [](auto& S) { S.Textures[1].bMirrorU = true; }, [](auto& S) { S.Textures[1].bNearest = true; },
	              [](auto& S) { S.Materials[1].BaseColor.z = 0.5f; }, [](auto& S) { S.Materials[1].Emissive.x = 1.0f; },
	              [](auto& S) { S.Materials[1].Roughness = 0.5f; }, [](auto& S) { S.Materials[1].AlphaCutoff = 0.25f; },
	              [](auto& S) { S.Materials[1].AlphaMode = EAlphaMode::Mask; }, [](auto& S) { S.Materials[1].bDoubleSided = true; },
	              [](auto& S) { S.Materials[1].Slots[TEXTURE_NORMAL].Texture = 1; },
	              [](auto& S) { S.Materials[1].Slots[TEXTURE_NORMAL].Offset.y = 1.0f; },
	              [](auto& S) { S.Materials[1].Program = "Own.glsl"; }, [](auto& S) { S.Meshes[0].Positions[2].y = 2.0f; },
	              [](auto& S) { S.Materials[1].LightEmissive = glm::vec3(1); }, [](auto& S) { S.Meshes[0].Positions[2].x = 2.0f; },
	              [](auto& S) { S.Meshes[0].Attributes[2].Normal = 5; }, [](auto& S) { S.Meshes[0].Skin[0].Weights[3] = 1.0f; },
	              [](auto& S) {
		S.Meshes[0].Indices = {0, 2, 1};
	},
	    [](auto& S) { S.Meshes[0].Sections[0].Material = 1; }, [](auto& S) { S.Nodes[1].Parent = 0; },
	    [](auto& S) { S.Nodes[1].Translation.x = 1e-9; }, [](auto& S) { S.Nodes[1].Matrix = glm::dmat4(1.0); },
	    [](auto& S) { S.Nodes[0].Materials = {0}; }, [](auto& S) { S.Nodes[0].Materials.clear(); }, [](auto& S) { S.Nodes[1].Light = 0; },
	    [](auto& S) { S.Nodes.emplace_back(); }, [](auto& S) { S.Skins[0].InverseBind[0][3][0] = 1.0f; },
	    [](auto& S) { S.Animations[0].Channels[0].Times[1] = 2.0f; },
	    [](auto& S) { S.Animations[0].Channels[0].Path = EAnimationPath::Scale; }, [](auto& S) { S.Animations[0].Duration = 2.0f; },
	    [](auto& S) { S.Lights[0].Color.y = 2.0f; }, [](auto& S) { S.Lights[0].OuterCone = 0.5f; },
	    };
	std::set<std::string> Seen = {HashScene(MakeScene()).ToHex()};
	for (size_t I = 0; I < std::size(Changes); ++I)
	{
		FSceneDescription Scene = MakeScene();
		Changes[I](Scene);
		EXPECT_TRUE(Seen.insert(HashScene(Scene).ToHex()).second) << "change " << I;
	}
}

TEST(FSceneHashTest, TextsDoNotFlowIntoEachOther)
{
	FContentHasher A, B;
	A.AddText("ab");
	A.AddText("c");
	B.AddText("a");
	B.AddText("bc");
	EXPECT_NE(A.Finish(), B.Finish());
}

} // namespace
} // namespace Lantern
