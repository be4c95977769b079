// SPDX-License-Identifier: MIT
// What the C# classes promise, tried against objects that only remember (stub). The oracle is the class reference, read here once
// more: every member, method and signal in it has its counterpart, which asks the engine by the very name.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Xml.Linq;
using Godot;
using SoftBodies;

static class Claims
{
	private static int _passed, _failed;

	private static void Check(bool holds, string claim)
	{
		if (holds)
		{
			_passed++;
		}
		else
		{
			_failed++;
			Console.WriteLine("FAILED: " + claim);
		}
	}

	private static bool Throws<T>(Action action) where T : Exception
	{
		try
		{
			action();
			return false;
		}
		catch (T)
		{
			return true;
		}
	}

	/// The oracle of names: youngs_modulus is YoungsModulus.
	private static string Named(string name)
	{
		return string.Concat(name.Split('_').Select(part => char.ToUpperInvariant(part[0]) + part.Substring(1)));
	}

	/// A value of a type that is not its default, and that a Variant takes.
	private static object Sample(Type type)
	{
		type = Nullable.GetUnderlyingType(type) ?? type;
		if (type.IsEnum) return Enum.GetValues(type).GetValue(Enum.GetValues(type).Length - 1);
		if (type == typeof(bool)) return true;
		if (type == typeof(int)) return 7;
		if (type == typeof(long)) return 1L << 40;
		if (type == typeof(uint)) return 0x80000001u;
		if (type == typeof(double)) return 0.1;
		if (type == typeof(string)) return "text";
		if (type == typeof(Vector2)) return new Vector2(3, 4);
		if (type == typeof(Color)) return new Color(0.25f, 0.5f, 0.75f);
		if (type == typeof(Rid)) return new Rid { Id = 5 };
		if (type == typeof(Transform2D)) return new Transform2D(0, new Vector2(1, 2));
		if (type == typeof(NodePath)) return new NodePath("../Other");
		if (type == typeof(NodePath[])) return new[] { new NodePath("A"), new NodePath("B") };
		if (type == typeof(byte[])) return new byte[] { 1, 2 };
		if (type == typeof(int[])) return new[] { 1, 2 };
		if (type == typeof(float[])) return new[] { 1.5f };
		if (type == typeof(Vector2[])) return new[] { new Vector2(1, 1) };
		if (type == typeof(Vector2[][])) return new[] { new[] { new Vector2(1, 1), new Vector2(2, 1) }, new[] { new Vector2(3, 3) } };
		if (type == typeof(Color[])) return new[] { new Color(1, 0, 0) };
		return Activator.CreateInstance(type); // objects
	}

	private static bool Same(object a, object b)
	{
		var many = a as System.Collections.IEnumerable;
		if (many != null && !(a is string))
		{
			return many.Cast<object>().Select(Text).SequenceEqual(((System.Collections.IEnumerable)b).Cast<object>().Select(Text));
		}
		return Equals(a, b);
	}

	private static string Text(object value)
	{
		var items = value as System.Collections.IEnumerable;
		return items != null && !(value is string) && !(value is NodePath) ? "[" + string.Join(";", items.Cast<object>().Select(Text)) + "]" : TextOfOne(value);
	}

	private static string TextOfOne(object value) { return value is NodePath ? value.ToString() : Convert.ToString(value) + value.GetHashCode(); }

	/// What the compiler passes for an argument that is left out.
	private static object Default(ParameterInfo parameter)
	{
		Type type = parameter.ParameterType;
		bool isStruct = type.IsValueType && !type.IsPrimitive && Nullable.GetUnderlyingType(type) == null;
		return isStruct ? Activator.CreateInstance(type) : parameter.DefaultValue;
	}

	private static bool IsOfEngine(Type type) { return typeof(GodotObject).IsAssignableFrom(type); }

	private static GodotObject EngineObject(object wrapper, Type type)
	{
		PropertyInfo held = type.GetProperty("Node") ?? type.GetProperty("Resource") ?? type.GetProperty("Instance");
		return (GodotObject)held.GetValue(wrapper);
	}

	private static void CheckMember(object wrapper, Type type, GodotObject engine, XElement member)
	{
		string name = (string)member.Attribute("name");
		PropertyInfo property = type.GetProperty(Named(name));
		Check(property != null, type.Name + " has the property " + Named(name));
		if (property == null)
		{
			return;
		}
		bool canWrite = (string)member.Attribute("setter") != "";
		Check(property.CanRead && property.CanWrite == canWrite, type.Name + "." + property.Name + " is written as the class reference has it");
		engine.Asked.Clear();
		if (canWrite)
		{
			object value = Sample(property.PropertyType);
			property.SetValue(wrapper, value);
			Check(engine.Asked.SequenceEqual(new[] { "set " + name }), type.Name + "." + property.Name + " sets " + name);
			engine.Asked.Clear();
			Check(Same(property.GetValue(wrapper), value), type.Name + "." + property.Name + " returns what was set");
		}
		else
		{
			property.GetValue(wrapper);
		}
		Check(engine.Asked.SequenceEqual(new[] { "get " + name }), type.Name + "." + property.Name + " gets " + name);
	}

	private static void CheckMethod(object wrapper, Type type, GodotObject engine, XElement method)
	{
		string name = (string)method.Attribute("name");
		MethodInfo found = type.GetMethods().FirstOrDefault(one => one.Name == Named(name) && one.DeclaringType == type);
		Check(found != null, type.Name + " has the method " + Named(name));
		if (found == null)
		{
			return;
		}
		List<XElement> parameters = method.Elements("param").ToList();
		ParameterInfo[] taken = found.GetParameters();
		Check(taken.Length == parameters.Count, type.Name + "." + found.Name + " takes as many arguments");
		Check(taken.Zip(parameters, (one, other) => one.IsOptional == (other.Attribute("default") != null)).All(fits => fits),
			type.Name + "." + found.Name + " has the same optional arguments");
		bool isStatic = ((string)method.Attribute("qualifiers") ?? "").Contains("static");
		Check(found.IsStatic == (isStatic || wrapper == null), type.Name + "." + found.Name + " is static where the method is");
		object[] arguments = taken.Select(one => Sample(one.ParameterType)).ToArray();
		GodotObject.All.Clear();
		engine.Asked.Clear();
		found.Invoke(wrapper, arguments);
		GodotObject asked = isStatic ? GodotObject.All.Single(one => one.Asked.Count > 0) : engine;
		Check(asked.Asked.SequenceEqual(new[] { "call " + name }), type.Name + "." + found.Name + " calls " + name);
		Check(asked.LastArguments.Length == taken.Length && asked.LastArguments.All(one => one.Held != null), type.Name + "." + found.Name + " hands over its arguments");
		Check(!isStatic || asked.IsFreed, type.Name + "." + found.Name + " frees what it made for the call");
		found.Invoke(wrapper, taken.Select(one => one.IsOptional ? Default(one) : Sample(one.ParameterType)).ToArray());
		Check(asked.LastArguments.Zip(taken, (one, other) => one.Held != null || IsOfEngine(other.ParameterType)).All(fits => fits),
			type.Name + "." + found.Name + " fills what is left out");
	}

	private static void CheckSignal(object wrapper, Type type, GodotObject engine, XElement signal)
	{
		string name = (string)signal.Attribute("name");
		EventInfo found = type.GetEvent(Named(name));
		Check(found != null, type.Name + " has the event " + Named(name));
		if (found == null)
		{
			return;
		}
		MethodInfo invoke = found.EventHandlerType.GetMethod("Invoke");
		Check(invoke.GetParameters().Length == signal.Elements("param").Count(), type.Name + "." + found.Name + " takes what the signal gives");
		var parameters = invoke.GetParameters().Select(one => System.Linq.Expressions.Expression.Parameter(one.ParameterType)).ToArray();
		Delegate listener = System.Linq.Expressions.Expression.Lambda(found.EventHandlerType, System.Linq.Expressions.Expression.Empty(), parameters).Compile();
		found.AddEventHandler(wrapper, listener);
		Check(engine.Connected.Count == 1 && engine.Connected[0].Key == name, type.Name + "." + found.Name + " connects to " + name);
		found.RemoveEventHandler(wrapper, listener);
		Check(engine.Connected.Count == 0, type.Name + "." + found.Name + " disconnects the same listener");
		FieldInfo constant = type.GetNestedType("SignalName").GetField(Named(name));
		Check(constant.GetValue(null).ToString() == name, type.Name + ".SignalName has " + name);
	}

	private static void CheckConstants(Type type, XElement root)
	{
		foreach (XElement constant in root.Descendants("constant"))
		{
			string group = (string)constant.Attribute("enum");
			Type found = type.GetNestedType(group) ?? type.GetNestedType(group + "Enum");
			string name = (string)constant.Attribute("name");
			object value = found == null ? null : Enum.GetValues(found).Cast<object>().FirstOrDefault(one => Convert.ToInt64(one) == (long)constant.Attribute("value"));
			Check(value != null && Named(name.ToLowerInvariant()).EndsWith(value.ToString(), StringComparison.Ordinal), type.Name + " has " + name);
		}
	}

	private static void CheckClass(string file)
	{
		XElement root = XDocument.Load(file).Root;
		string name = (string)root.Attribute("name");
		Type type = typeof(SoftBody2D).Assembly.GetType("SoftBodies." + name);
		Check(type != null, "there is a class " + name);
		bool isSingleton = Engine.Singletons.ContainsKey(name);
		object wrapper = isSingleton ? null : Activator.CreateInstance(type);
		GodotObject engine = isSingleton ? Engine.Singletons[name] : EngineObject(wrapper, type);
		Check(engine.GetClass() == name, "a new " + name + " is one of the engine's");
		foreach (XElement member in root.Descendants("member")) CheckMember(wrapper, type, engine, member);
		foreach (XElement method in root.Descendants("method")) CheckMethod(wrapper, type, engine, method);
		foreach (XElement signal in root.Descendants("signal")) CheckSignal(wrapper, type, engine, signal);
		CheckConstants(type, root);
	}

	private static void CheckValues()
	{
		var body = new SoftBody2D();
		body.Integrator = SoftBody2D.IntegratorEnum.Xpbd;
		Check((long)body.Node.Values["integrator"].Held == 7, "an enumeration is handed over as its number");
		body.Mass = 0.1;
		Check((double)body.Node.Values["mass"].Held == 0.1, "a number keeps all its digits");
		var material = new SoftBodyMaterial2D();
		body.SoftBodyMaterial = material;
		Check(body.Node.Values["soft_body_material"].Held == material.Resource, "a material is handed over as the engine's object");
		Check(body.SoftBodyMaterial == material && body.SoftBodyMaterial.Equals(material), "two faces of one object are equal");
		body.SoftBodyMaterial = null;
		Check(body.SoftBodyMaterial == null, "no material is null");
		var pieces = new Godot.Collections.Array();
		pieces.Add(body.Node);
		body.Node.Answer = pieces;
		SoftBody2D[] cut = body.Cut(new Vector2(0, -10), new Vector2(0, 10));
		Check(cut.Length == 1 && cut[0] == body, "a cut returns the bodies");
		body.ApplyCentralImpulse();
		Check(((Vector2)body.Node.LastArguments[0].Held).Equals(new Vector2()), "a default argument is the class reference's");
		new SoftBodyPreview2D().AddFloor(new Vector2(1, 2));
		Node2D node = body;
		Check(node == body.Node && SoftBody2D.From(node) == body, "a body is a Node2D for the tree, and back");
		Check(SoftBody2D.From(null) == null && SoftBody2D.Is(node) && !SoftBody2D.Is(null) && !SoftBody2D.Is(new Node2D()), "From and Is know what is none");
		Check(Throws<InvalidCastException>(() => SoftBody2D.From(new Node2D())), "another node is refused");
		Check(body != new SoftBody2D(), "two bodies differ");
		ClassDB.Parents["SoftRope2D"] = "SoftBody2D";
		SoftRope2D rope = new SoftRope2D();
		Check(rope.AsSoftBody2D.Node == rope.Node && SoftBody2D.Is(rope), "a rope is a soft body, and shows its members");
		Check(!SoftRope2D.Is(node) && SoftRope2D.From(rope.AsSoftBody2D) == rope, "a soft body need not be a rope");
	}

	private static void CheckWithoutLibrary()
	{
		ClassDB.Known.Clear();
		Check(Throws<InvalidOperationException>(() => new SoftBody2D()), "without the library a new body is refused with the reason");
	}

	static int Main(string[] arguments)
	{
		var bases = new Dictionary<string, Func<GodotObject>>
		{
			{ "Node2D", () => new Node2D() }, { "Area2D", () => new Area2D() }, { "Polygon2D", () => new Polygon2D() }, { "Resource", () => new Resource() }, { "RefCounted", () => new RefCounted() },
		};
		string[] files = Directory.GetFiles(arguments[0], "*.xml").Where(file => Path.GetFileName(file) != "SoftBodyPicker.xml").ToArray();
		foreach (string file in files)
		{
			XElement root = XDocument.Load(file).Root;
			string name = (string)root.Attribute("name"), parent = (string)root.Attribute("inherits");
			if (parent == "Object")
			{
				Engine.Singletons[name] = new GodotObject { ClassName = name };
			}
			else
			{
				ClassDB.Known[name] = bases[parent == "SoftBody2D" ? "Node2D" : parent]; // a rope is a soft body
			}
		}
		foreach (string file in files)
		{
			CheckClass(file);
		}
		CheckValues();
		CheckWithoutLibrary();
		Console.WriteLine(_passed + " passed, " + _failed + " failed");
		return _failed == 0 ? 0 : 1;
	}
}
