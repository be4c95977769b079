// SPDX-License-Identifier: MIT
// Loads the extension as Godot 4.3 would, and calls its entry. Functions that are newer than 4.3 are refused, and all others do
// nothing: that is enough for an extension to say whether it would load there.
//
// Usage: stub_host LIBRARY FUNCTIONS    where FUNCTIONS is a file with the names that Godot 4.3 has, one a line
// Prints how many functions the extension asked for and which were refused; 0 if the entry returns 1.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

typedef void (*Function)(void);
typedef Function (*FindFunction)(const char *name);
struct Initialization {
	int minimum_level;
	void *userdata;
	void (*initialize)(void *userdata, int level);
	void (*deinitialize)(void *userdata, int level);
};
struct Version {
	uint32_t major, minor, patch;
	const char *string;
};
typedef uint8_t (*Entry)(FindFunction find, void *library, struct Initialization *initialization);

#define MOST_NAMES 1024
static char *known[MOST_NAMES], *asked[MOST_NAMES];
static int known_count, asked_count, refused_count;

static int is_in(char **names, int count, const char *name) {
	for (int i = 0; i < count; ++i) {
		if (strcmp(names[i], name) == 0) {
			return 1;
		}
	}
	return 0;
}

static void add(char **names, int *count, const char *name) {
	if (*count == MOST_NAMES) {
		fputs("too many names\n", stderr);
		exit(2);
	}
	names[*count] = malloc(strlen(name) + 1);
	strcpy(names[(*count)++], name);
}

// What functions of the interface give is often a function, so this one gives itself.
static void *nothing(void) {
	return (void *)nothing;
}

// WebAssembly calls a function only by its own type, so what the entry calls has one here, and so does what it gets from that.
static void construct(void *to, const void *const *from) {
	(void)to, (void)from;
}

static void destroy(void *value) {
	(void)value;
}

static void *constructor(int type, int32_t index) {
	(void)type, (void)index;
	return (void *)construct;
}

static void *destructor(int type) {
	(void)type;
	return (void *)destroy;
}

static void *of_type(int type) {
	(void)type;
	return (void *)nothing;
}

static void *of_member(int type, const void *name) {
	(void)type, (void)name;
	return (void *)nothing;
}

static void *of_operator(int operation, int left, int right) {
	(void)operation, (void)left, (void)right;
	return (void *)nothing;
}

static void *of_method(int type, const void *name, int64_t hash) {
	(void)type, (void)name, (void)hash;
	return (void *)nothing;
}

static void *of_function(const void *name, int64_t hash) {
	(void)name, (void)hash;
	return (void *)nothing;
}

static void new_name(void *to, const char *text, uint8_t is_static) {
	(void)to, (void)text, (void)is_static;
}

static void new_text(void *to, const char *text) {
	(void)to, (void)text;
}

static void get_version(struct Version *version) {
	version->major = 4;
	version->minor = 3;
	version->patch = 0;
	version->string = "Godot Engine v4.3 (stub)";
}

static void print_error(const char *description, const char *function, const char *file, int32_t line, uint8_t notify) {
	(void)notify;
	printf("error of the extension: %s (%s, %s:%d)\n", description, function, file, (int)line);
}

static void *allocate(size_t size) {
	return calloc(1, size);
}

static void *reallocate(void *memory, size_t size) {
	return realloc(memory, size);
}

static void release(void *memory) {
	free(memory);
}

static const struct {
	const char *name;
	Function function;
} answers[] = {
	{ "get_godot_version", (Function)get_version },
	{ "print_error", (Function)print_error },
	{ "mem_alloc", (Function)allocate },
	{ "mem_realloc", (Function)reallocate },
	{ "mem_free", (Function)release },
	{ "variant_get_ptr_constructor", (Function)constructor },
	{ "variant_get_ptr_destructor", (Function)destructor },
	{ "get_variant_from_type_constructor", (Function)of_type },
	{ "get_variant_to_type_constructor", (Function)of_type },
	{ "variant_get_ptr_indexed_setter", (Function)of_type },
	{ "variant_get_ptr_indexed_getter", (Function)of_type },
	{ "variant_get_ptr_keyed_setter", (Function)of_type },
	{ "variant_get_ptr_keyed_getter", (Function)of_type },
	{ "variant_get_ptr_keyed_checker", (Function)of_type },
	{ "variant_get_ptr_setter", (Function)of_member },
	{ "variant_get_ptr_getter", (Function)of_member },
	{ "variant_get_ptr_operator_evaluator", (Function)of_operator },
	{ "variant_get_ptr_builtin_method", (Function)of_method },
	{ "variant_get_ptr_utility_function", (Function)of_function },
	{ "string_name_new_with_latin1_chars", (Function)new_name },
	{ "string_name_new_with_utf8_chars", (Function)new_text },
	{ "string_new_with_latin1_chars", (Function)new_text },
	{ "string_new_with_utf8_chars", (Function)new_text },
};

static Function find(const char *name) {
	if (!is_in(asked, asked_count, name)) {
		add(asked, &asked_count, name);
	}
	if (!is_in(known, known_count, name)) {
		printf("refused: %s\n", name);
		++refused_count;
		return NULL;
	}
	for (size_t i = 0; i < sizeof(answers) / sizeof(answers[0]); ++i) {
		if (strcmp(name, answers[i].name) == 0) {
			return answers[i].function;
		}
	}
	return (Function)nothing;
}

static Entry entry_of(const char *path) {
#ifdef _WIN32
	HMODULE library = LoadLibraryA(path);
	if (library == NULL) {
		printf("%s does not load: error %lu\n", path, GetLastError());
		return NULL;
	}
	return (Entry)(void *)GetProcAddress(library, "soft_body_2d_library_init");
#else
	void *library = dlopen(path, RTLD_NOW);
	if (library == NULL) {
		printf("%s does not load: %s\n", path, dlerror());
		return NULL;
	}
	return (Entry)dlsym(library, "soft_body_2d_library_init");
#endif
}

int main(int count, char **arguments) {
	char line[256];
	struct Initialization initialization = { 0 };
	FILE *functions = count == 3 ? fopen(arguments[2], "r") : NULL;
	if (functions == NULL) {
		fputs("usage: stub_host LIBRARY FUNCTIONS\n", stderr);
		return 2;
	}
	while (fgets(line, sizeof(line), functions) != NULL) {
		line[strcspn(line, "\r\n")] = 0;
		add(known, &known_count, line);
	}
	fclose(functions);
	Entry entry = entry_of(arguments[1]);
	if (entry == NULL) {
		return 1;
	}
	const int result = entry(find, &initialization, &initialization);
	printf("Godot 4.3: the entry returns %d; %d functions asked for, %d refused\n", result, asked_count, refused_count);
	fflush(stdout);
	return result == 1 && refused_count == 0 && initialization.initialize != NULL ? 0 : 1;
}
