// Skins and animations.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "Gltf/GltfDocument.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern::Gltf
{

namespace
{

bool IsFinite(const float* Values, size_t Count)
{
	return std::all_of(Values, Values + Count, [](float V) { return std::isfinite(V); });
}

FHostSkin ReadSkin(FDocument& Document, const FJson& Json)
{
	FHostSkin Skin;
	const FJson Joints = Json.Member("joints");
	if (Joints.Count() == 0) { Json.Fail("has no joints"); }
	for (size_t I = 0; I < Joints.Count(); ++I)
	{
		const FJson Joint = Joints.Element(I);
		const uint64_t Node = Joint.ToUInt(UINT64_MAX);
		if (Node >= Document.NodeRemap.size())
		{
			Joint.Fail(fmt::format("there is no node {} (there are {})", Node, Document.NodeRemap.size()));
		}
		Skin.Joints.push_back(Document.NodeRemap[Node]);
	}
	const int32_t Bind = Json.GetIndex("inverseBindMatrices", Document.Accessors.size(), "accessor");
	if (Bind < 0)
	{
		Skin.InverseBind.assign(Skin.Joints.size(), glm::mat4(1));
		return Skin;
	}
	const FAccessor& Accessor = Document.Accessors[size_t(Bind)];
	if (Accessor.Components != 16 || Accessor.Elements.Type != EComponent::F32 || Accessor.Count < Skin.Joints.size())
	{
		Json.Fail(fmt::format("inverseBindMatrices is no list of {} float matrices", Skin.Joints.size()));
	}
	Document.ChargeGeometry(Json, Accessor.Count, sizeof(glm::mat4));
	Skin.InverseBind = ReadMat4(Accessor);
	Skin.InverseBind.resize(Skin.Joints.size());
	for (size_t I = 0; I < Skin.InverseBind.size(); ++I)
	{
		if (!IsFinite(&Skin.InverseBind[I][0][0], 16)) { Json.Fail(fmt::format("inverse bind matrix {} is not finite", I)); }
	}
	return Skin;
}

/// A mesh does not know which skin it will meet; only here can its joints be checked.
void CheckJoints(FDocument& Document)
{
	FSceneDescription& Scene = Document.Scene;
	const FJson Nodes = Document.Root.Member("nodes");
	std::vector<int32_t> MaxJoint(Scene.Meshes.size(), -1);
	for (size_t M = 0; M < Scene.Meshes.size(); ++M)
	{
		for (const FSkinWeights& Weights : Scene.Meshes[M].Skin)
		{
			MaxJoint[M] = std::max(MaxJoint[M], int32_t(*std::max_element(Weights.Joints.begin(), Weights.Joints.end())));
		}
	}
	for (size_t I = 0; I < Scene.Nodes.size(); ++I)
	{
		FHostNode& Node = Scene.Nodes[I];
		if (Node.Skin < 0) { continue; }
		if (MaxJoint[size_t(Node.Mesh)] < 0)
		{
			Document.Warn("skinned nodes whose mesh has no JOINTS_0 and WEIGHTS_0 are rendered rigid");
			Node.Skin = -1;
		}
		else
		{
			const FHostSkin& Skin = Scene.Skins[size_t(Node.Skin)];
			if (size_t(MaxJoint[size_t(Node.Mesh)]) >= Skin.Joints.size())
			{
				throw FError(fmt::format("node {}: its mesh refers to joint {}, but skins[{}] has {}", Quote(Node.Name),
				    MaxJoint[size_t(Node.Mesh)], Node.Skin, Skin.Joints.size()));
			}
			// Every skinned node needs vertices and joints of its own, whoever bends them.
			Document.ChargeGeometry(Nodes, Scene.Meshes[size_t(Node.Mesh)].Positions.size(), 24);
			Document.ChargeGeometry(Nodes, Skin.Joints.size(), sizeof(glm::mat4));
		}
	}
}

} // namespace

void ReadSkins(FDocument& Document)
{
	const FJson Skins = Document.Root.Member("skins");
	for (size_t I = 0; I < Skins.Count(); ++I)
	{
		const FJson Json = Skins.Element(I);
		Document.Scene.Skins.push_back(ReadSkin(Document, Json));
	}
	CheckJoints(Document);
}

namespace
{

void ReadTimes(FDocument& Document, const FJson& Sampler, FHostChannel& Channel)
{
	const int32_t Input = Sampler.RequireIndex("input", Document.Accessors.size(), "accessor");
	const FAccessor& Accessor = Document.Accessors[size_t(Input)];
	if (Accessor.Components != 1 || Accessor.Elements.Type != EComponent::F32 || Accessor.Count == 0)
	{
		Sampler.Fail("'input' is no list of float times");
	}
	Document.ChargeGeometry(Sampler, Accessor.Count, sizeof(float));
	Channel.Times = ReadScalars(Accessor);
	for (size_t I = 0; I < Channel.Times.size(); ++I)
	{
		if (!std::isfinite(Channel.Times[I]) || Channel.Times[I] < 0 || (I > 0 && Channel.Times[I] < Channel.Times[I - 1]))
		{
			Sampler.Fail(fmt::format("time {} is not finite, negative or before the one before it", I));
		}
	}
}

void ReadValues(FDocument& Document, const FJson& Sampler, FHostChannel& Channel)
{
	const std::string Interpolation = Sampler.GetString("interpolation", "LINEAR");
	if (Interpolation != "LINEAR" && Interpolation != "STEP" && Interpolation != "CUBICSPLINE")
	{
		Sampler.Fail(fmt::format("{} is no interpolation", Quote(Interpolation)));
	}
	Channel.Interpolation = Interpolation == "LINEAR" ? EInterpolation::Linear
	                        : Interpolation == "STEP" ? EInterpolation::Step
	                                                  : EInterpolation::CubicSpline;
	const int32_t Output = Sampler.RequireIndex("output", Document.Accessors.size(), "accessor");
	const FAccessor& Accessor = Document.Accessors[size_t(Output)];
	const uint32_t Components = Channel.Path == EAnimationPath::Rotation ? 4 : 3;
	const size_t PerKey = Channel.Interpolation == EInterpolation::CubicSpline ? 3 : 1;
	if (Accessor.Components != Components || Accessor.Count != Channel.Times.size() * PerKey)
	{
		Sampler.Fail(fmt::format("'output' has {} × {} numbers, expected {} × {}", Accessor.Count, Accessor.Components,
		    Channel.Times.size() * PerKey, Components));
	}
	Document.ChargeGeometry(Sampler, Accessor.Count, sizeof(glm::vec4));
	Channel.Values = ReadVec4(Accessor, glm::vec4(0));
	for (size_t I = 0; I < Channel.Values.size(); ++I)
	{
		// A bound, too: products of transforms must stay finite.
		if (!IsFinite(&Channel.Values[I][0], 4) || glm::any(glm::greaterThan(glm::abs(Channel.Values[I]), glm::vec4(1e18f))))
		{
			Sampler.Fail(fmt::format("value {} is not finite or too large", I));
		}
	}
}

bool ReadTarget(FDocument& Document, const FJson& Channel, FHostChannel& Out)
{
	const FJson Target = Channel.Member("target");
	const int32_t Node = Target.GetIndex("node", Document.NodeRemap.size(), "node");
	const std::string Path = Target.GetString("path", "");
	if (Path == "weights" || Path == "pointer")
	{
		Document.Warn("animations of morph targets and by pointer are not played");
		return false;
	}
	if (Path != "translation" && Path != "rotation" && Path != "scale")
	{
		Channel.Fail(fmt::format("{} is nothing that can be animated", Quote(Path)));
	}
	if (Node < 0)
	{
		return false; // the specification wants such channels ignored
	}
	Out.Node = Document.NodeRemap[size_t(Node)];
	Out.Path = Path == "translation" ? EAnimationPath::Translation : Path == "rotation" ? EAnimationPath::Rotation : EAnimationPath::Scale;
	if (Document.Scene.Nodes[size_t(Out.Node)].Matrix) { Channel.Fail(fmt::format("node {} is animated but has a matrix", Node)); }
	return true;
}

} // namespace

void ReadAnimations(FDocument& Document)
{
	const FJson Animations = Document.Root.Member("animations");
	for (size_t A = 0; A < Animations.Count(); ++A)
	{
		const FJson Json = Animations.Element(A);
		FHostAnimation Animation;
		Animation.Name = Json.GetString("name", "");
		const FJson Channels = Json.Member("channels");
		const FJson Samplers = Json.Member("samplers");
		for (size_t C = 0; C < Channels.Count(); ++C)
		{
			const FJson ChannelJson = Channels.Element(C);
			const int32_t SamplerIndex = ChannelJson.RequireIndex("sampler", Samplers.Count(), "sampler");
			const FJson Sampler = Samplers.Element(size_t(SamplerIndex));
			FHostChannel Channel;
			if (ReadTarget(Document, ChannelJson, Channel))
			{
				ReadTimes(Document, Sampler, Channel);
				ReadValues(Document, Sampler, Channel);
				Animation.Duration = std::max(Animation.Duration, Channel.Times.back());
				Animation.Channels.push_back(std::move(Channel));
			}
		}
		if (!Animation.Channels.empty()) { Document.Scene.Animations.push_back(std::move(Animation)); }
	}
}

} // namespace Lantern::Gltf
